// SPDX-License-Identifier: Apache-2.0
// See value_fault.h. The ranges are those of the rows in src/scene/keys/view.cpp and light.cpp;
// tests/embed/value_fault_test.cpp holds both together.
#include "src/session/value_fault.h"

#include "src/base/single.h"
#include "src/scene/view_fault.h"

namespace pileus {
namespace {

/// False for what is no number.
bool is_within(double v, double low, double high) { return v >= low && v <= high; }

template <class Vector>
bool are_within(const Vector& v, double low, double high) {
    return is_within(double(v[0]), low, high) && is_within(double(v[1]), low, high) &&
           is_within(double(v[2]), low, high);
}

constexpr double kFar = 1e9;

bool is_sound_sphere(const Ground& ground, const LightSettings& l) {
    const double height = l.position_m[2] - ground.altitude_m;
    return !ground.present || l.shadow_samples == 1 || height < 0 || l.radius_m <= height;
}

const char* light_fault(const Ground& ground, const LightSettings& l) {
    if (l.type == LampKind::kDirectional) {
        if (!is_within(l.azimuth_deg, -360, 360)) return "light.azimuth_deg";
        if (!is_within(l.elevation_deg, -90, 90)) return "light.elevation_deg";
        return are_within(l.irradiance, 0, 1e9) ? nullptr : "light.irradiance";
    }
    if (!are_within(l.position_m, -kFar, kFar)) return "light.position_m";
    if (!are_within(l.intensity, 0, 1e18)) return "light.intensity";
    if (!is_within(l.radius_m, 0, kFar) || !is_sound_sphere(ground, l)) return "light.radius_m";
    if (l.shadow_samples < 1 || l.shadow_samples > 64) return "light.shadow_samples";
    if (l.type == LampKind::kPoint) return nullptr;
    const bool points = l.direction != Double3{} && are_within(l.direction, -kFar, kFar);
    if (!points) return "light.direction";
    if (!is_within(l.cone_deg, kLeastPositive, 360)) return "light.cone_deg";
    return is_within(l.penumbra_deg, 0, l.cone_deg / 2) ? nullptr : "light.penumbra_deg";
}

template <class Vector>
void hold_three(Vector& v) {
    for (int a = 0; a < 3; ++a) v[std::size_t(a)] = single_or_0(v[std::size_t(a)]);
}

}  // namespace

Camera held(Camera c) {
    for (Double3* v : {&c.position_m, &c.target_m, &c.up}) *v = single_or_0(*v);
    return c;
}

Sun held(Sun sun) {
    sun.azimuth_deg = single_or_0(sun.azimuth_deg);
    sun.elevation_deg = single_or_0(sun.elevation_deg);
    hold_three(sun.irradiance);
    return sun;
}

Ground held(Ground ground) {
    ground.altitude_m = single_or_0(ground.altitude_m);
    ground.albedo = single_or_0(ground.albedo);
    return ground;
}

LightSettings held(LightSettings l) {
    for (Double3* v : {&l.position_m, &l.direction, &l.target_m}) *v = single_or_0(*v);
    for (double* v : {&l.radius_m, &l.azimuth_deg, &l.elevation_deg, &l.penumbra_deg})
        *v = single_or_0(*v);
    hold_three(l.intensity);
    hold_three(l.irradiance);
    return l;
}

void hold(Sky& sky) {
    hold_three(sky.radiance);
    sky.map_scale = single_or_0(sky.map_scale);
    sky.map_rotation_deg = single_or_0(sky.map_rotation_deg);
}

const char* camera_fault(const Scene& scene, const Ground& ground, const Camera& c) {
    if (!are_within(c.position_m, -kFar, kFar)) return "camera.position_m";
    if (!are_within(c.target_m, -kFar, kFar)) return "camera.target_m";
    if (!are_within(c.up, -kFar, kFar)) return "camera.up";
    if (!is_within(c.fov_deg, kLeastFovDeg, 180) || float(c.fov_deg) == 180.0f)
        return "camera.fov_deg";
    if (!is_within(c.height_m, kLeastPositive, kFar)) return "camera.height_m";
    for (const int n : c.resolution)
        if (n < 1 || n > 16384) return "camera.resolution";
    // Some methods and the air know one kind alone.
    if (c.orthographic != scene.camera.orthographic || c.flux != scene.camera.flux)
        return "camera.projection";
    switch (view_fault(ground, c)) {
        case ViewFault::kAtTarget:
            return "camera.target_m";
        case ViewFault::kAlongUp:
            return "camera.up";
        case ViewFault::kUnderground:
            return "camera.position_m";
        case ViewFault::kNone:
            break;
    }
    const bool high = c.position_m[2] - ground.altitude_m > 100000;
    return scene.atmosphere.present && ground.present && high ? "camera.position_m" : nullptr;
}

const char* sun_fault(const Sun& sun) {
    if (!is_within(sun.azimuth_deg, -360, 360)) return "sun.azimuth_deg";
    if (!is_within(sun.elevation_deg, -90, 90)) return "sun.elevation_deg";
    return are_within(sun.irradiance, 0, 1e12) ? nullptr : "sun.irradiance";
}

const char* sky_fault(const Scene& scene, const Sky& sky) {
    if (scene.atmosphere.present || sky.mapped) return "sky";
    return are_within(sky.radiance, 0, 1e12) ? nullptr : "sky.radiance";
}

const char* ground_fault(const Scene& scene, const Camera& camera, const Ground& ground) {
    if (!is_within(ground.altitude_m, -kFar, kFar)) return "ground.altitude_m";
    if (!is_within(ground.albedo, 0, 1)) return "ground.albedo";
    if (!scene.lights.empty() || scene.atmosphere.present) return "ground";
    const bool below = ground.present && camera.position_m[2] < ground.altitude_m;
    return below ? "camera.position_m" : nullptr;
}

const char* lights_fault(const Scene& scene, const Ground& ground,
                         const std::vector<LightSettings>& lights) {
    // What a scene with lights may have else was asked when it got its first.
    if (scene.lights.empty() && !lights.empty()) return "light";
    if (lights.size() > kMostLights) return "light";
    for (const LightSettings& light : lights)
        if (const char* key = light_fault(ground, held(light))) return key;
    return nullptr;
}

}  // namespace pileus
