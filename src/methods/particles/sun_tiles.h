// SPDX-License-Identifier: Apache-2.0
// Optical depth from every particle towards a light far away: particles by tiles across its
// direction, so that a place meets those alone that may lie in its way.
// in: a tree, a direction -> out: a depth for each ball. docs/particles.md, "Light".
#pragma once
#include "src/methods/scenery.h"
#include "src/world/particles/particle_tree.h"

namespace pileus {

/// Balls sorted into tiles for one direction. u and v are across it, w along it.
struct SunTiles {
    const ParticleTree* tree = nullptr;      ///< its balls are lit
    Span<const ParticleBall> casts;          ///< these cast shadows
    double middle[3] = {}, axis[3][3] = {};  ///< u, v, w = dot(axis, place - middle)
    float low[2] = {}, side = 1;             ///< m
    int across[2] = {1, 1};                  ///< tiles along u and v
    Buffer<std::uint64_t> begin;             ///< [tile] in balls, and one behind the last
    Buffer<std::uint32_t> balls;             ///< that may lie in the way

    std::uint32_t count() const { return std::uint32_t(across[0]) * std::uint32_t(across[1]); }
};

namespace arrays {

/// At most; larger tiles name fewer balls twice.
inline Array<std::uint32_t> tile_balls(std::uint64_t particles) {
    return {"particles by tiles", bytes_of(4, particles), Stage::kShadow, Stage::kShadow};
}
/// A share of the particles, drawn one by one: 6 standard deviations and more than the mean.
inline Array<ParticleBall> particle_occluders(std::uint64_t particles) {
    return {"particles that cast shadows", particles, Stage::kShadow, Stage::kWrite};
}
inline Array<std::uint32_t> tile_places(std::uint64_t particles) {
    return {"places by tiles", particles, Stage::kShadow, Stage::kShadow};
}

}  // namespace arrays

/// What one thread works in, bytes.
std::uint64_t sun_tile_scratch_bytes();

/// About a share of the balls, denser in return, chosen by their ids or, without any, by their own
/// numbers. kLimit: out of memory.
Status choose_occluders(const ParticleTree& tree, double share, Buffer<ParticleBall>& chosen);

/// `direction`: unit, to the light. The tree, which holds a ball, and `casts` must outlive the
/// tiles. kLimit: out of memory.
Status make_sun_tiles(const Context& context, const ParticleTree& tree,
                      Span<const ParticleBall> casts, const std::array<float, 3>& direction,
                      SunTiles& tiles);

/// Depth of each ball, `offset` radii from its centre on; what is deeper than `most` is `most`.
/// Neither threads nor the width of kernels change a bit. Progress is told as that of one of so
/// many passes. kLimit: out of memory.
Status sun_depths(const Context& context, SunTiles& tiles, const std::array<float, 3>& offset,
                  float most, float* depth, int pass = 0, int passes = 1);

}  // namespace pileus
