// SPDX-License-Identifier: Apache-2.0
// Settings of every method; which one is used: Description::method.
// in: keys of [method] -> out: plain values. docs/scene.md
#pragma once
#include "src/scene/methods/collectors_settings.h"
#include "src/scene/methods/optical_depth_settings.h"
#include "src/scene/methods/particles_settings.h"
#include "src/scene/methods/path_settings.h"
#include "src/scene/methods/photon_grid_settings.h"
#include "src/scene/methods/raymarch_settings.h"

namespace pileus {

struct MethodTables {
    CollectorSettings collectors;
    PathSettings path;
    FilterSettings filter;
    RaymarchSettings raymarch;
    OpticalDepthSettings optical_depth;
    PhotonGridSettings photon_grid;
    ParticlesSettings particles;
};

}  // namespace pileus
