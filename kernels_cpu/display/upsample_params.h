// SPDX-License-Identifier: Apache-2.0
// What upsampling and temporal reprojection from few marched rays need: plain structs and pointers.
// in: the pixels that were marched, the picture before -> out: the layout of a launch.
// docs/upsampling.md
#pragma once
#include "kernels_cpu/display/march_params.h"

namespace pileus {

/// How pixels between marched ones are filled.
enum UpsampleRule : std::int32_t {
    kUpsampleDepth = 0,  ///< bilinear, and neighbours before other solid things count little
    kUpsampleLinear = 1,
    kUpsampleNearest = 2,
};

struct UpsampleParams {
    PixelLattice lattice;
    std::int32_t rule;  ///< an UpsampleRule
    CameraParams camera;
    std::int32_t remembers;  ///< 1: there is a picture before
    std::int32_t still;      ///< 1: of the same view and light, so nothing of it is stale
    CameraParams before;     ///< its camera
    MediumView medium;       ///< its box: where rays are when no depth is known
};

struct UpsampleBuffers {
    // Marched pixels.
    const float* transmittance;
    const float* colour;        ///< [3][pixel]
    const float* half_depth;    ///< m, or infinity; null: not wanted
    const float* ray_depth;     ///< null: not wanted
    const float* opaque_depth;  ///< null: nothing solid
    // The picture's.
    const float* whole_opaque;          ///< null: nothing solid
    const float* before_transmittance;  ///< unused unless `remembers`
    const float* before_colour;
    const float* before_opaque;
    float* whole_transmittance;
    float* whole_colour;
    float* whole_half;   ///< null: not wanted
    float* whole_depth;  ///< null: not wanted
    std::int64_t* kept;  ///< [row]: pixels taken from the picture before
};

}  // namespace pileus
