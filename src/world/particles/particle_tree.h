// SPDX-License-Identifier: Apache-2.0
// A loose octree over particles, flat, in the order of a walk.
// in: placed particles -> out: nodes and balls as the kernels take them.
// Monette and Whitehead 2014, 3.1; Morton 1966; docs/particles.md, "The octree".
#pragma once
#include "kernels_cpu/particles/particle_params.h"
#include "src/io/particles/particles.h"
#include "src/plan/array.h"

namespace pileus {

/// Made once, then read only.
struct ParticleTree {
    Buffer<ParticleNode> nodes;  ///< one more than there are: its end
    Buffer<ParticleBall> balls;  ///< in the order of the leaves
    Buffer<float> velocity;      ///< [ball][axis], m/s; empty: at rest
    Buffer<float> colour;        ///< [ball][channel]: factor on the albedo; empty: 1
    Buffer<float> emission;      ///< [ball][channel]: factor on the emission; empty: 1
    Buffer<std::uint64_t> id;    ///< [ball]: numbers in the file; empty: none
    std::uint32_t leaves = 0;
    int depth = 0;  ///< of the deepest leaf; the root's is 0

    std::int32_t count() const { return nodes.empty() ? 0 : std::int32_t(nodes.size()) - 1; }
    ParticleView view() const { return {nodes.data(), count(), balls.data()}; }
};

/// Levels below the root: bits of a place along each axis.
constexpr int kParticleLevels = 21;
/// Most particles that nodes and balls are numbered for.
constexpr std::uint64_t kMaxTreeParticles = std::uint64_t{1} << 30;

namespace arrays {

/// Velocities, colours or emission.
inline Array<float> particle_vectors(std::uint64_t particles) {
    return {"vectors of particles", bytes_of(particles, 3), Stage::kDensity, Stage::kWrite};
}
inline Array<std::uint64_t> particle_numbers(std::uint64_t particles) {
    return {"numbers of particles", particles, Stage::kDensity, Stage::kWrite};
}
inline Array<ParticleBall> particle_balls(std::uint64_t particles) {
    return {"particles", particles, Stage::kDensity, Stage::kWrite};
}
/// An upper bound: an inner node has two children or more.
inline Array<ParticleNode> particle_nodes(std::uint64_t particles) {
    return {"octree", 2 * particles + 1, Stage::kDensity, Stage::kWrite};
}

}  // namespace arrays

/// Particles by their centres into leaves of at most `most_in_leaf`, but for those that the last
/// level does not part; boxes hold their balls whole. Metres are counted from `low`. Neither the
/// order of the particles nor a thread changes a bit. kLimit: out of memory, or too many.
Status make_particle_tree(const ParticleSet& set, const Double3& low, int most_in_leaf, int threads,
                          ParticleTree& tree);

}  // namespace pileus
