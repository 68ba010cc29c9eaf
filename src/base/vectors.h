// SPDX-License-Identifier: Apache-2.0
// Vectors of the host side: places, directions, colours, by GLM. Kernels have lanes of their own.
// docs/determinism.md, "How": of GLM only what adds, multiplies, divides and takes
// roots may reach a pixel; nothing of it that calls libm.
#pragma once
#include <array>
#include <glm/vec3.hpp>

#include "src/base/angles.h"

namespace pileus {

using Double3 = glm::dvec3;
using Float3 = std::array<float, 3>;

/// Unit vector towards an azimuth, clockwise from north (y), and an elevation.
inline Double3 towards_deg(double azimuth_deg, double elevation_deg) {
    const SineCosine el = sincos_deg(elevation_deg), az = sincos_deg(azimuth_deg);
    return {az.sine * el.cosine, az.cosine * el.cosine, el.sine};
}

/// By -yaw about the z axis.
inline Double3 turned_back(const Double3& v, const SineCosine& yaw) {
    return {v.x * yaw.cosine + v.y * yaw.sine, v.y * yaw.cosine - v.x * yaw.sine, v.z};
}

}  // namespace pileus
