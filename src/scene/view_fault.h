// SPDX-License-Identifier: Apache-2.0
// What is wrong with a camera's place and view, whoever places it.
// in: a camera in metres, the ground -> out: the first fault.
// docs/scene.md
#pragma once
#include <glm/geometric.hpp>

#include "src/base/single.h"
#include "src/scene/scene.h"

namespace pileus {

/// Whether two points are too near for the direction from one to the other.
inline bool is_at(const Double3& a, const Double3& b) {
    return !(glm::length(b - a) >= least_distance(a, b));
}

enum class ViewFault { kNone, kAtTarget, kAlongUp, kUnderground };

/// Along up: by less than a sine of 1e-6, below which the picture's axes lose precision; a zero
/// vector for up is along every view.
inline ViewFault view_fault(const Ground& ground, const Camera& c) {
    constexpr double kLeastSine = 1e-6;
    const Double3 view = c.target_m - c.position_m;
    const double length = glm::length(view);
    if (is_at(c.position_m, c.target_m)) return ViewFault::kAtTarget;
    if (!(glm::length(glm::cross(view, c.up)) > kLeastSine * length * glm::length(c.up)))
        return ViewFault::kAlongUp;
    const bool below = ground.present && c.position_m[2] < ground.altitude_m;
    return below ? ViewFault::kUnderground : ViewFault::kNone;
}

}  // namespace pileus
