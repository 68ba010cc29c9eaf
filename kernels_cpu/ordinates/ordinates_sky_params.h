// SPDX-License-Identifier: Apache-2.0
// What discrete ordinates of a sky in place need: the layer, and nodes of a level.
// in: a sky, levels of nodes around a camera -> out: the layout of a launch.
// docs/ordinates.md, "Skies"
#pragma once
#include "kernels_cpu/ordinates/ordinates_params.h"
#include "kernels_cpu/procedural/sky_params.h"

namespace pileus {

struct OrdinatesSkyParams {
    OrdinatesMarchParams march;
    SkyParams sky;
};

/// Places in a layer, in rows along x: at the middles of size[2] parts of its height.
struct SkyPlaces {
    std::int32_t size[3];
    float low[2], step[2];  ///< m, box-local
};

/// Rows of samples: their density, or where `sunward` is 1 the optical depth from there to the sun.
struct SkySampleParams {
    RaymarchParams march;  ///< its way to the sun
    SkyParams sky;
    SkyPlaces places;
    float width_m;  ///< details below are averaged
    std::int32_t sunward;
};
struct SkySampleBuffers {
    float* density;  ///< [z][y][x]; read where depths are made
    float* depth;    ///< likewise; 0 where there is no density
};

/// Rows of nodes: what they scatter towards the camera.
struct SkyNodeTurnParams {
    SkyParams sky;
    SkyPlaces places;
    std::int32_t ring;  ///< 1: the outermost nodes along x and y are not made
    std::int32_t orthographic;
    float camera[3];   ///< place, m, box-local; or the way that it looks
    float scatter[4];  ///< by degree
};
struct SkyNodeTurnBuffers {
    const float* moments;  ///< [kOrdinateMoments][node] without the ring
    float* light;          ///< [node]
};

}  // namespace pileus
