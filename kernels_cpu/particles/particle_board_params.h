// SPDX-License-Identifier: Apache-2.0
// What the blender of particles as billboards reads and writes.
// in: particles as a camera sees them -> out: planes of pixels. Lengths in metres.
// docs/particles.md, "Billboards".
#pragma once
#include "kernels_cpu/particles/particle_params.h"

namespace pileus {

/// A particle on the screen: its middle has the optical depth `whole`, and at the distance q from
/// there, in shown radii, it has whole (1 - q^2)^power. Vectors go along the camera's right, up and
/// forward.
struct ParticleBoard {
    float at[3];       ///< from the camera's position, in the middle of the shutter's time
    float way[3];      ///< that it moves while the shutter is open
    float per_square;  ///< 1 / shown radius^2
    float whole, power;
    float per_radius;               ///< 1 / its own radius, along the view
    float distance;                 ///< of its middle; nearer ones are blended first
    float colour[3];                ///< radiance of an opaque one
    std::uint16_t low[2], high[2];  ///< pixels whose centres it may cover; none: low above high
};

struct ParticleBoardParams {
    CameraParams camera;
    const ParticleBoard* boards;
    std::int32_t moving;  ///< 1: some move while the shutter is open
    std::int32_t curved;  ///< 1: powers differ from that of a ball's chord, 5/2
    float cut;            ///< of transmittance, below which nothing is seen
};
/// Planes go on from what they hold: 1, 0, infinity and 0 before the first launch.
struct ParticleBoardBuffers {
    const float* opaque_depth;  ///< [pixel], m along the ray; null: nothing solid
    float* transmittance;       ///< [pixel]
    float* colour;              ///< [channel][pixel]
    float* half_depth;          ///< [pixel], m; null: not wanted
    float* optical_depth;       ///< [pixel]; null: not wanted
};

struct ParticleBoardTileBuffers {
    ParticleBoardBuffers board;
    const ParticleTile* tiles;  ///< of different pixels
};

/// Colours of boards, one for each ball.
struct ParticleColourBuffers {
    const ParticleShade* shade;  ///< [ball]
    const float* sky;            ///< [channel][ball]: light from around; null: none
    const float* seen;           ///< [ball]: share of the sun that solids leave; null: all
    const float* tint;           ///< [ball][channel]: factor on the albedo; null: 1
    std::uint64_t balls;         ///< their number
    ParticleBoard* boards;       ///< [ball]
};

}  // namespace pileus
