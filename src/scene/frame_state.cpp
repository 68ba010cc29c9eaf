// SPDX-License-Identifier: Apache-2.0
// See frame_state.h.
#include "src/scene/frame_state.h"

#include <glm/geometric.hpp>

#include "src/base/angles.h"

namespace pileus {
bool same_view(const Camera& a, const Camera& b) {
    return a.position_m == b.position_m && a.target_m == b.target_m && a.up == b.up &&
           a.orthographic == b.orthographic && a.fov_deg == b.fov_deg && a.height_m == b.height_m &&
           a.resolution == b.resolution && a.window == b.window && a.has_frustum == b.has_frustum &&
           (!a.has_frustum || a.frustum == b.frustum);
}

bool same_sun(const Sun& a, const Sun& b) {
    return a.present == b.present && a.azimuth_deg == b.azimuth_deg &&
           a.elevation_deg == b.elevation_deg && a.irradiance == b.irradiance;
}

bool are_within(const Sun& a, const Sun& b, double degrees) {
    const Double3 from = towards_deg(a.azimuth_deg, a.elevation_deg);
    const Double3 to = towards_deg(b.azimuth_deg, b.elevation_deg);
    // |a - b| = 2 sin(angle / 2), whose halves are small.
    return glm::length(from - to) <= 2 * sincos_deg(0.5 * degrees).sine;
}

bool shine_alike(const Sun& a, const Sun& b) {
    constexpr float kShare = 0.01f;
    for (std::size_t c = 0; c < 3; ++c) {
        const float off = a.irradiance[c] - b.irradiance[c];
        if ((off < 0 ? -off : off) > kShare * a.irradiance[c]) return false;
    }
    return a.present == b.present;
}

bool same_ground(const Ground& a, const Ground& b) {
    return a.present == b.present && a.altitude_m == b.altitude_m && a.albedo == b.albedo;
}

void put_in_media(const FrameState& host, FrameState& out) {
    out = host;
    const Double3& offset = host.placement.offset_m;
    if (host.placement.yaw_deg == 0 && offset == Double3{}) return;
    const SineCosine yaw = sincos_deg(host.placement.yaw_deg);
    Camera& c = out.camera;
    c.position_m = turned_back(host.camera.position_m - offset, yaw);
    c.target_m = turned_back(host.camera.target_m - offset, yaw);
    c.up = turned_back(host.camera.up, yaw);
    out.sun.azimuth_deg += host.placement.yaw_deg;
    for (LightSettings& light : out.lights) {
        light.position_m = turned_back(light.position_m - offset, yaw);
        light.target_m = turned_back(light.target_m - offset, yaw);
        light.direction = turned_back(light.direction, yaw);
        light.azimuth_deg += host.placement.yaw_deg;
    }
    out.ground.altitude_m -= offset.z;
}

}  // namespace pileus
