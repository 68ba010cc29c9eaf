// SPDX-License-Identifier: Apache-2.0
// What others draw in who show more than a session's own media.
// in: a live session -> out: its camera, light, air and ground as they are now.
// docs/clouds.md
#pragma once
#include "kernels_cpu/core/camera.h"
#include "src/scene/scene.h"
#include "src/session/session.h"

namespace pileus {

/// Points into the session, until it is changed.
struct Outlook {
    const Context* context = nullptr;
    const Scene* scene = nullptr;
    const World* world = nullptr;
    Environment* environment = nullptr;
    Lighting lighting;
    CameraParams camera{};  ///< in metres from the world's low corner
    int frame = 0;
};

}  // namespace pileus
