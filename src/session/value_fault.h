// SPDX-License-Identifier: Apache-2.0
// Whether what a host sets in each frame is in range, told without taking memory.
// in: values of a host, the session's scene -> out: the key of the first fault, or null.
// docs/scene.md has the ranges; docs/flight.md
#pragma once
#include <vector>

#include "src/base/status.h"
#include "src/scene/scene.h"

namespace pileus {

/// Values as they are used: 0 where single precision has no other number (src/base/single.h).
Camera held(Camera camera);
Sun held(Sun sun);
Ground held(Ground ground);
LightSettings held(LightSettings light);
void hold(Sky& sky);

/// Each returns null only where check_scene would find nothing, if the scene itself is sound. Of
/// what is seldom set it may name a key that check_scene allows: that decides.
/// `scene`: the session's, with the ground as the host has it.
const char* camera_fault(const Scene& scene, const Ground& ground, const Camera& camera);
const char* sun_fault(const Sun& sun);
const char* sky_fault(const Scene& scene, const Sky& sky);
const char* ground_fault(const Scene& scene, const Camera& camera, const Ground& ground);
const char* lights_fault(const Scene& scene, const Ground& ground,
                         const std::vector<LightSettings>& lights);

/// The fault of a value that is refused: check_scene's on the changed scene, or none where that
/// finds none. `key` names it.
Status check_changed(const char* key, const Scene& scene, void (*change)(const void*, Scene&),
                     const void* values);

/// The same with a function of a lambda.
template <class Change>
Status check_changed(const char* key, const Scene& scene, const Change& change) {
    return check_changed(
        key, scene,
        [](const void* values, Scene& changed) { (*static_cast<const Change*>(values))(changed); },
        &change);
}

}  // namespace pileus
