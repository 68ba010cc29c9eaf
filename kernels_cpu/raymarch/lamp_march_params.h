// SPDX-License-Identifier: Apache-2.0
// What the march of light from lamps and of the media's own needs: plain structs and pointers.
// in: lamps, a medium, a camera -> out: the layout of a launch.
// docs/lights.md, "By marching".
#pragma once
#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/light/lamp_params.h"
#include "kernels_cpu/raymarch/raymarch_params.h"
#include "kernels_cpu/solids/solids_params.h"

namespace pileus {

struct LampMarchParams {
    MediumView medium;
    CameraParams camera;
    std::int32_t media;  ///< on the grid, up to kMaxMedia; 0: surfaces alone are lit
    PhaseParams phase[kMaxMedia];
    float albedo[kMaxMedia][3];
    float emission[kMaxMedia][3];  ///< as in Optics
    std::int32_t emits;            ///< 0: none is added
    Octaves octaves;               ///< of the lamps' light
    OctaveDepths octave_depths;
    float octave_g[kMaxMedia][kMaxOctaves];          ///< as RaymarchLight has them
    float octave_source[kMaxMedia][kMaxOctaves][3];  ///< of a unit of light; from octave 1 on
    std::int32_t forward;      ///< 1: light scattered forward goes on as if it were not
    float kept[kMaxMedia][3];  ///< and so much of what is scattered does, as RaymarchLight has it
    std::int32_t beam_sets;    ///< as MarchParams has them, of one medium: what stays in the lamps'
    std::int32_t beam_points;  ///< beams; 1: there are tables of points, too
    float beam_rest[3];
    /// Light scattered more than once comes from discrete ordinates: channels of what is left where
    /// turns within the peak of a phase function do not count, 1 or 3; 0: it does not.
    std::int32_t ordinates;
    float rest[kMaxMedia][3];  ///< as OrdinatesMarchParams has it
    float peak_turn;           ///< 1 - cos of the peak's width
    float surface_rest[3];     ///< of the extinction, what keeps light from surfaces
    std::int32_t lamps;
    std::int32_t spheres;  ///< 0: none of them is one
    NodeGrid nodes;        ///< of optical depths to each lamp
    float cut;             ///< stop below this transmittance
    std::int32_t ground;   ///< 0: none
    float ground_z;        ///< m
    float ground_albedo;
    GroundPaint paint;
    SolidsView solids;  ///< lit, too, and in each other's way; none: of other methods
};

struct LampMarchBuffers {
    const LampParams* lamps;
    float* optical_depth;       ///< [lamp][node]
    const float* beam;          ///< MarchBuffers::beam, and behind it the same from a point
    const float* parts;         ///< [medium - 1][voxel]: densities of media 1, 2 ...
    const float* opaque_depth;  ///< [pixel], m along the ray; null: nothing opaque
    float* colour;              ///< [3][pixel], premultiplied; added to
    float* background;          ///< [3][pixel], added to where rays end at surfaces; null: none
};

}  // namespace pileus
