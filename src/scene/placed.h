// SPDX-License-Identifier: Apache-2.0
// Media that move: camera, lights and ground go the other way, so that no cell does.
// in: what surrounds the media, where they have gone -> out: the scene in the media's coordinates.
// docs/animation.md; docs/embedding.md, "What may change"
#pragma once
#include <vector>

#include "src/base/angles.h"
#include "src/scene/frames.h"

namespace pileus {

/// What surrounds the media, in the coordinates of the scene's file or of a host.
struct Surround {
    Camera camera;
    Sun sun;
    Ground ground;
    std::vector<LightSettings> lights;

    Surround() = default;
    explicit Surround(const Scene& s)
        : camera(s.camera), sun(s.sun), ground(s.ground), lights(s.lights) {}
};

/// By -yaw about the z axis.
Double3 turned_back(const Double3& v, const SineCosine& yaw);

void place_around(const Surround& around, const Placement& placement, Scene& scene);

/// The scene as it is at a frame, where keys move it; `rest`: as it is but for keys.
void place_keys(const Surround& rest, int frame, Scene& scene);

}  // namespace pileus
