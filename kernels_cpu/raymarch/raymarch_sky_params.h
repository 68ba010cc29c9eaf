// SPDX-License-Identifier: Apache-2.0
// What marches through a sky in place need: the march, and the layer that it reads.
// in: a scene's sky, a camera -> out: the layout of a launch.
// docs/skies.md, "Evaluated directly"
#pragma once
#include "kernels_cpu/procedural/sky_params.h"
#include "kernels_cpu/raymarch/raymarch_params.h"

namespace pileus {

struct RaymarchSkyParams {
    RaymarchParams march;
    SkyParams sky;
};

/// Nodes of sunlight in the layer; the view's words are not read.
struct SkyLightParams {
    RaymarchParams march;
    SkyParams sky;
    SkyLightView view;
};
struct SkyLightBuffers {
    const SkyLightRow* rows;
    std::int32_t* words;  ///< as SkyLightView has them
    std::int64_t* read;   ///< [row]: densities
};

}  // namespace pileus
