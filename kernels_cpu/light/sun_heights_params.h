// SPDX-License-Identifier: Apache-2.0
// The sun's light by height, in air, as kernels read it.
// in: src/world/environment.h -> out: a view of its table. docs/atmosphere.md, "The sun's colour"
#pragma once
#include <cstdint>

namespace pileus {

struct SunHeights {
    const float* depth;  ///< [channel][row]: optical depth towards the sun, of heights that rise
                         ///< evenly
    std::int32_t rows;   ///< 0: no air, the same light at every height; else >= 2
    float low;           ///< z of the first row, m, box-local
    float rows_per_metre;
    float above[3];  ///< irradiance above the air
};

}  // namespace pileus
