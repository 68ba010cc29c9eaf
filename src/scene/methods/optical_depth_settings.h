// SPDX-License-Identifier: Apache-2.0
// Settings of method optical-depth.
// in: keys of [method.optical_depth] -> out: plain values. docs/scene.md
#pragma once
#include <array>

#include "src/base/vectors.h"

namespace pileus {

/// Method optical-depth; src/scene/keys/optical_depth.cpp says what each means.
struct OpticalDepthSettings {
    int steps = 0;                           ///< of a ray; 0: one a cell
    bool exact = false;                      ///< buffer = "exact"
    std::array<int, 3> resolution{0, 0, 0};  ///< cells of the buffer; 0: the medium's
    double intensity = 1;
    Float3 ambient{0, 0, 0};
    double powder_strength = 1, powder_depth = 2;
    bool powder_by_extinction = false;
    double g = -2;                    ///< within [-1, 1]: instead of the medium's phase function
    double max_extinction_per_m = 0;  ///< 0: no bound
    double light_scale = 1;           ///< on extinction towards the sun
    double stop_below = 1e-4;
};

}  // namespace pileus
