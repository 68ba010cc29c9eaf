// SPDX-License-Identifier: Apache-2.0
// How a picture of radiance is shown by 8-bit files.
// in: options of a command line -> out: what develop.h takes.
// docs/exposure.md
#pragma once

namespace pileus {

/// Curves from radiance times gain to light of a display; docs/exposure.md has formulas and
/// sources.
enum class Tone {
    kStandard,   ///< Narkowicz' fit of ACES; highlights lose colour
    kHable,      ///< Hable's curve of 2010
    kAgx,        ///< Wrensch's fit of Sobotka's AgX
    kAgxPunchy,  ///< the same with its "punchy" look
    kLinear,     ///< none: clipped at 1
};

struct ToneSettings {
    bool automatic = false;  ///< measures the picture first; `stops` then count from what it found
    float stops = 0;         ///< doublings of the light, [-64, 64]
    Tone tone = Tone::kStandard;
    double white_k = 0;  ///< colour temperature shown as white, K, [2000, 25000]; 0: as it is
    double glare = 0;    ///< share of the light that is spread, [0, 1]
};

}  // namespace pileus
