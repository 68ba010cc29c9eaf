// SPDX-License-Identifier: Apache-2.0
// The sRGB curve backwards, the same bits on every machine.
// in: an encoded value in [0, 1] -> out: light in [0, 1].
// IEC 61966-2-1; docs/formats.md
#pragma once
#include "src/base/powers.h"

namespace pileus {

/// Display-linear light of an encoded value; kernels_cpu/display/tone.h has the way back.
inline double linear_of_srgb(double v) {
    return v <= 0.04045 ? v / 12.92 : power_of((v + 0.055) / 1.055, 2.4);
}

}  // namespace pileus
