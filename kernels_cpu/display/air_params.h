// SPDX-License-Identifier: Apache-2.0
// What the kernel of the air in front of a picture needs: tables around the camera, planes.
// in: the atmosphere as the camera stands in it -> out: the layout of a launch.
// docs/atmosphere.md; src/picture/air_view.h fills it.
#pragma once
#include "kernels_cpu/display/march_params.h"

namespace pileus {

/// Numbers of a texel: R G B without haze scattered once, R G B of that without its phase function,
/// two of nothing.
constexpr int kAirTexel = 8;

struct AirRowsParams {
    MediumView medium;  ///< its box alone
    CameraParams camera;
    float to_sun[3];
    float haze_g;
    float above[3];  ///< the sun's irradiance above the air, whose shares the tables hold
    float rayleigh[3], haze[3], ozone[3];  ///< extinction where each is densest, 1/km
    float horizon;                         ///< of the sky: cosine to the vertical
    std::int32_t downs, ups, turns;        ///< rows below and above it, columns of the sky
    std::int32_t rows, columns, slices;    ///< of the air: directions, distances; odd rows
    float height, room;    ///< m, of the camera above the ground, and to the top of the air; >= 0
    float reach;           ///< m, the most that slices reach
    std::int32_t solid;    ///< 1: opaque_depth tells what is solid
    std::int32_t through;  ///< 1: `behind` is what is seen through the media, 0: what stands there
};
struct AirRowsBuffers {
    const float* sky;            ///< [row][column][kAirTexel], to the end of the air
    const float* air;            ///< [slice][row][column][kAirTexel], from the camera to a
                                 ///< distance: light over the share that the air takes
    const float* transmittance;  ///< [pixel], of the media
    const float* half_depth;     ///< [pixel], m; infinity: not known
    const float* opaque_depth;   ///< [pixel], m
    float* light;                ///< [3][pixel], the media's; taken and given back
    float* behind;               ///< [3][pixel], likewise
    float* dimmed;               ///< [3][pixel], transmittance to the media; null: not wanted
    float* kept;  ///< [3][pixel], transmittance to what stands behind, 0: the sky; null: not wanted
};

}  // namespace pileus
