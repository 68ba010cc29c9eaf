// SPDX-License-Identifier: Apache-2.0
// What the kernels of particles read and write: a tree of boxes over balls, rays, light, pixels.
// in: the scene's stages -> out: the layout of a launch. Lengths in metres, box-local.
// docs/particles.md, "The method".
#pragma once
#include "kernels_cpu/core/camera.h"
#include "kernels_cpu/light/lamp_params.h"
#include "kernels_cpu/media/phase.h"

namespace pileus {

/// A box about balls, in the order of a walk that takes the first child first. A leaf has
/// skip = its own number + 1, and the balls from `first` to that of the node behind it.
struct ParticleNode {
    float low[3];
    std::int32_t skip;  ///< the node after all that this one holds
    float high[3];
    std::int32_t first;  ///< the first ball of all that it holds
};

/// Of extinction e at its centre, at distance r e (1 - r^2 / R^2)^2 within the radius R.
struct ParticleBall {
    float centre[3];
    float per_radius;  ///< 1 / R
    float depth;       ///< extinction at the centre times R
};

struct ParticleView {
    const ParticleNode* nodes;  ///< and one behind the last: its `first` is the number of balls
    std::int32_t node_count;
    const ParticleBall* balls;
};

/// A ball that may lie between places and a light far away. u and v are across the light's
/// direction, w grows towards the light.
struct ParticleOccluder {
    float u, v, w;
    float per_square;   ///< 1 / R^2
    float whole;        ///< depth on a ray through the centre: 16/15 of that of ParticleBall
    float back, front;  ///< w + R and w - R
    float per_radius;
};

/// Adds up the optical depth from places towards the light, over occluders in their order.
struct ParticleDepthParams {
    const ParticleOccluder* occluders;  ///< `back` falls
    std::int32_t count;
    float most;  ///< what is deeper counts as this; 3e38: no bound
};
struct ParticleDepthBuffers {
    const float *u, *v, *w;  ///< [place]; any order is right, falling w is fast
    float* depth;            ///< [place], added to
};

constexpr int kMaxParticleOrders = 8;
/// Sums of a bin: optical depth; that times the depth towards the sun, or times the place along the
/// ray; that times light from around; that times the share that solids leave of the sun; that times
/// colours.
constexpr int kParticleSums = 9;

/// Optical depth towards the sun within a ball: `depth` at its centre, and how much more a radius
/// farther along each axis.
struct ParticleShade {
    float depth, slope[3];
};

struct ParticleMarchParams {
    ParticleView view;
    CameraParams camera;
    std::int32_t bins;                  ///< along a ray's way through the box of all
    std::int32_t orders;                ///< of the sun's light, 0 to kMaxParticleOrders; 0: no sun
    float sun_travel[3];                ///< unit, away from the sun
    float sun[kMaxParticleOrders][3];   ///< irradiance times albedo times the order's share
    float thinner[kMaxParticleOrders];  ///< factor on the depth towards the sun
    PhaseParams phase;                  ///< of the first order
    float order_g[kMaxParticleOrders];  ///< of Henyey-Greenstein; from the second order on
    float albedo[3];
    std::int32_t exact;  ///< 1: a walk towards the sun from each bin; 0: what `shade` says
    float most;          ///< of that walk: it ends where it is as deep
    float cut;           ///< of transmittance, below which nothing is seen
};
struct ParticleMarchBuffers {
    const ParticleShade* shade;  ///< [ball]
    const float* sky;            ///< [channel][ball]: light from around; null: none
    const float* seen;           ///< [ball]: share of the sun that solids leave; null: all
    const float* tint;           ///< [ball][channel]: factor on the albedo; null: 1
    std::uint64_t balls;         ///< their number
    const float* opaque_depth;   ///< [pixel], m along the ray; null: nothing solid
    float* transmittance;        ///< [pixel]
    float* colour;               ///< [channel][pixel]
    float* half_depth;           ///< [pixel], m; null: not wanted
    float* optical_depth;        ///< [pixel]; null: not wanted
    float* scratch;  ///< particle_scratch_floats() of one thread, aligned to 64 bytes; all 0, as
                     ///< each launch leaves it
};

/// A ball that may be seen, and the least distance along a ray at which it begins.
struct ParticleSeen {
    float front;
    std::uint32_t ball;
};
/// Pixels [x_begin, x_end) of rows [y_begin, y_end), begins multiples of 4.
struct ParticleTile {
    std::int32_t x_begin, y_begin, x_end, y_end;
    const ParticleSeen* seen;  ///< `front` rises; null: any ball, found by a walk
    std::int32_t count;        ///< of seen; 0: no ball at all
};

struct ParticleTileBuffers {
    ParticleMarchBuffers march;
    const ParticleTile* tiles;
};

/// Most lanes of a launch.
constexpr int kMaxParticleLanes = 16;
constexpr std::uint64_t particle_scratch_floats(std::int32_t bins) {
    return std::uint64_t(bins) * kParticleSums * kMaxParticleLanes;
}
/// Of one thread with one lane.
constexpr std::uint64_t particle_scratch_share(std::int32_t bins) {
    return std::uint64_t(bins) * kParticleSums;
}

/// Depths from balls to a lamp: from one place each, `offset` radii from the centre.
struct ParticleLampDepths {
    ParticleView view;
    LampParams lamp;
    float offset[3];
    std::int32_t turned;  ///< not 0: `offset` is along the axes of light_axes, ball by ball
    float most;           ///< where a walk ends
};
struct ParticleLampDepthBuffers {
    float* depth;  ///< [ball]
};
/// Light of lamps that each ball scatters towards the camera.
struct ParticleLampLight {
    const LampParams* lamps;
    std::int32_t count;
    std::int32_t orders;                 ///< as ParticleMarchParams has them for the sun
    float share[kMaxParticleOrders][3];  ///< of each order, without the last albedo
    const float* depth;                  ///< [lamp][ball]
    const float* reach;                  ///< [lamp][ball]: its growth over a radius
    const float* seen;                   ///< [lamp][ball]: share that solids leave; null: all
    const float* sky;                    ///< [channel][ball], added; null: none
    const float* tint;                   ///< [ball][channel]: factor on the albedo; null: 1
    float* light;                        ///< [channel][ball]
    std::uint64_t balls;
};

}  // namespace pileus
