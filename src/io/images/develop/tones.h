// SPDX-License-Identifier: Apache-2.0
// Tone curves by name.
// in: linear sRGB radiance and a gain -> out: linear light of a display, 1 its white.
// docs/exposure.md, "Tone curves"
#pragma once
#include <string>

#include "kernels_cpu/display/tone.h"
#include "src/io/images/develop/tone_settings.h"

namespace pileus {

/// Negative light and NaN count as 0, light over 1e6 after the gain as 1e6. Greys stay greys, to
/// the bit; no channel of a grey falls where the light grows.
Rgb<float> apply_tone(Tone tone, Rgb<float> radiance, float gain);

/// "standard, hable, agx, agx-punchy, linear".
std::string tone_names();
/// False where there is no such name.
bool find_tone(const std::string& name, Tone& tone);

/// Gain that shows 18 % grey in sunlight as kStandard does, over that of kStandard; 1 for kLinear.
double tone_factor(Tone tone);

}  // namespace pileus
