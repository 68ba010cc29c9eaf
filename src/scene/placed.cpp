// SPDX-License-Identifier: Apache-2.0
// See placed.h.
#include "src/scene/placed.h"

namespace pileus {

Double3 turned_back(const Double3& v, const SineCosine& yaw) {
    return {v.x * yaw.cosine + v.y * yaw.sine, v.y * yaw.cosine - v.x * yaw.sine, v.z};
}

void place_around(const Surround& around, const Placement& placement, Scene& scene) {
    scene.camera = around.camera;
    scene.sun = around.sun;
    scene.ground = around.ground;
    scene.lights = around.lights;
    const Double3& offset = placement.offset_m;
    if (placement.yaw_deg == 0 && offset == Double3{}) return;
    const SineCosine yaw = sincos_deg(placement.yaw_deg);
    Camera& c = scene.camera;
    c.position_m = turned_back(around.camera.position_m - offset, yaw);
    c.target_m = turned_back(around.camera.target_m - offset, yaw);
    c.up = turned_back(around.camera.up, yaw);
    scene.sun.azimuth_deg += placement.yaw_deg;
    for (LightSettings& light : scene.lights) {
        light.position_m = turned_back(light.position_m - offset, yaw);
        light.target_m = turned_back(light.target_m - offset, yaw);
        light.direction = turned_back(light.direction, yaw);
        light.azimuth_deg += placement.yaw_deg;
    }
    scene.ground.altitude_m -= offset.z;
}

void place_keys(const Surround& rest, int frame, Scene& scene) {
    Surround around = rest;
    around.camera = camera_at(scene.animation, rest.camera, frame);
    const Placement placement = placement_at(scene, frame);
    place_around(around, placement, scene);
    // To the bit what the lights are made by.
    const SunPlace sun = sun_at(scene, frame);
    scene.sun.azimuth_deg = sun.azimuth_deg;
    scene.sun.elevation_deg = sun.elevation_deg;
}

}  // namespace pileus
