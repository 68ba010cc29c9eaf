// SPDX-License-Identifier: Apache-2.0
// What is wrong between the camera, the lights and the ground, whoever sets or moves them: the laws
// that no single range tells.
// in: values of a scene, a host or a frame -> out: the first fault.
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

inline bool is_underground(const Ground& ground, const Camera& c) {
    return ground.present && c.position_m[2] < ground.altitude_m;
}

/// Over a ground that is level for ever, clear air ends.
inline bool is_above_air(const AtmosphereSettings& air, const Ground& ground, const Camera& c) {
    constexpr double kTop = 100000;
    return air.present && ground.present && !(c.position_m[2] - ground.altitude_m <= kTop);
}

/// Of a sphere with soft shadows: what would shine from below the ground.
inline bool reaches_below(const Ground& ground, const LightSettings& l) {
    const double height = l.position_m[2] - ground.altitude_m;
    return ground.present && l.shadow_samples != 1 && height >= 0 && l.radius_m > height;
}

inline bool is_wide_edge(const LightSettings& l) { return l.penumbra_deg > l.cone_deg / 2; }

enum class FrameFault { kNone, kAtTarget, kAlongUp, kUnderground };
/// The key that each is a fault of.
constexpr const char* kFaultKeys[] = {nullptr, "camera.target_m", "camera.up", "camera.position_m"};

/// Along up: by less than a sine of 1e-6, below which the picture's axes lose precision; a zero
/// vector for up is along every view.
inline FrameFault frame_fault(const Ground& ground, const Camera& c) {
    constexpr double kMinSine = 1e-6;
    const Double3 view = c.target_m - c.position_m;
    const double length = glm::length(view);
    if (is_at(c.position_m, c.target_m)) return FrameFault::kAtTarget;
    if (!(glm::length(glm::cross(view, c.up)) > kMinSine * length * glm::length(c.up)))
        return FrameFault::kAlongUp;
    return is_underground(ground, c) ? FrameFault::kUnderground : FrameFault::kNone;
}

}  // namespace pileus
