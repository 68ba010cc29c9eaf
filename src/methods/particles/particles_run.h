// SPDX-License-Identifier: Apache-2.0
// A run of method `particles`.
// in: a scene -> out: its octree, light at each particle, planes of pixels.
// docs/particles.md, "The method".
#pragma once
#include <array>

#include "kernels_cpu/particles/particle_board_params.h"
#include "src/methods/methods.h"
#include "src/picture/layers.h"
#include "src/picture/nodes/sky_nodes.h"
#include "src/world/majorant/majorants.h"
#include "src/world/particles/particle_tree.h"

namespace pileus {

/// How much of the extinction towards the sun counts for an order of its light, how much of the
/// light it is, and its Henyey-Greenstein phase function; the first has the medium's.
struct ParticleOrder {
    float extinction = 1, share = 1, g = 0;
};

struct ParticlesRun : MethodRun {
    std::uint64_t particles = 0;  ///< once they are read; before: 0
    ParticleTree tree;
    Majorants majorants;  ///< of the grid, which ground and solids see
    int orders = 0;       ///< of the sun's light; 0: no sun
    std::array<ParticleOrder, kMostParticleOrders> order{};
    Buffer<ParticleShade> shade;  ///< [ball]
    Buffer<float> sky;            ///< [channel][ball]; empty: none
    SkyNodes sky_nodes;
    bool lit = false;  ///< for the sun below
    std::array<float, 3> to_sun{};
    CameraParams camera{};
    Planes planes;
};

namespace arrays {

inline Array<ParticleShade> particle_shades(std::uint64_t particles) {
    return {"particles' depths towards the sun", particles, Stage::kShadow, Stage::kWrite};
}
/// From one place in each particle after the other.
inline Array<float> particle_depths(std::uint64_t particles, int samples) {
    return {"particles' single depths", bytes_of(particles, std::uint64_t(samples)), Stage::kShadow,
            Stage::kShadow};
}
inline Array<float> particle_sky(std::uint64_t particles) {
    return {"particles' skylight", bytes_of(particles, 3), Stage::kShadow, Stage::kWrite};
}
inline Array<float> particle_bins(std::uint64_t threads, std::int32_t bins) {
    return {"bins along rays", bytes_of(threads, particle_scratch_floats(bins)), Stage::kDisplay,
            Stage::kDisplay};
}

inline Array<ParticleBoard> particle_boards(std::uint64_t particles) {
    return {"billboards", particles, Stage::kDisplay, Stage::kDisplay};
}

}  // namespace arrays

/// Walks towards the sun from each particle.
inline int light_samples(const ParticlesSettings& settings) {
    return settings.light == ParticleLight::kLinear ? 4 : 1;
}

/// The orders that a scene asks for.
void choose_orders(ParticlesRun& run);

/// Notes what runs and what is left out, and weighs memory. kLimit: more than the limits allow.
Status plan_particles(const Context& context, ParticlesRun& run);

/// Light at every particle, for the sun of the run's lighting; kept while that stays. kLimit: out
/// of memory.
Status light_particles(const Context& context, ParticlesRun& run);

/// Whether particles move while the shutter is open.
bool moves(const ParticlesRun& run);

/// As billboards, into the planes; `march` tells their light. The tree holds a ball. kLimit: out
/// of memory.
Status show_boards(const Context& context, const ParticleMarchParams& march, ParticlesRun& run);

/// Into the planes. kLimit: out of memory.
Status show_particles(const Context& context, ParticlesRun& run);

}  // namespace pileus
