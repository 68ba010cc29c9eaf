// SPDX-License-Identifier: Apache-2.0
// What paths that follow importance read of the light by discrete ordinates.
// in: nodes of that light, the sun's optical depth -> out: the layout of a launch.
// docs/importance.md
#pragma once
#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/media/phase_params.h"

namespace pileus {

/// Moments of a direction's light on a node: spherical harmonics up to degree 3.
constexpr int kImportanceMoments = 16;
/// Lobes about the sun that stand for light turned within the phase function's peak alone.
constexpr int kImportanceLobes = 3;
/// Depths for which the lobes are fitted, evenly in tau / (tau + kBeamDepth).
constexpr int kImportanceDepths = 256;
/// Most copies of one particle.
constexpr float kMaxCopies = 50.0f;
/// Windows are this share of the pixel's light wide open where no light is expected.
constexpr float kWindowFloor = 0.02f;

struct ImportanceParams {
    NodeGrid nodes;
    /// [node][16]: of an irradiance of 1 the upper half of each word, of a radiance of 1 the lower:
    /// the upper halves of floats. One cache line has all of a node.
    const std::int32_t* moments;
    std::int32_t sets;     ///< 1: the sun's alone; 2: and the sky's
    NodeGrid depth_nodes;  ///< of the sun's optical depth
    /// [node]: the node's the upper half of each word, that of the next one along x the lower;
    /// null: no sun.
    const std::int32_t* sun_depth;
    const float* beam;                 ///< tables of beam.h
    const float* lobes;                ///< [kImportanceDepths][kImportanceLobes], per irradiance
    float lobe_g[kImportanceLobes];    ///< mean cosines of the lobes
    float turned_g[kImportanceLobes];  ///< of the lobes turned by the phase function
    float moment[4];                   ///< the phase function's, degrees 0 to 3
    float albedo;
    float rest;                  ///< share of extinction that takes light out of the sun's beam
    float peak_turn;             ///< 1 - cos of the width of the phase function's peak
    float sun_share;             ///< of directions that are drawn about the sun; 0 without one
    float sun_g;                 ///< mean cosine of those
    float sun_worth, sky_worth;  ///< what light of the sun and the sky counts in windows
    float level;                 ///< least light of a pixel that windows reckon with
    float windows;               ///< copies of a particle that is worth its pixel's light
    std::int32_t sky_whole;      ///< 1: each path that meets the medium brings all of the sky
};

}  // namespace pileus
