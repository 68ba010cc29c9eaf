// SPDX-License-Identifier: Apache-2.0
// Skylight that reaches nodes over the medium, from a few directions: an approximation.
// in: a medium, sky and ground -> out: brightness per node in sets of one colour each.
// docs/raymarch.md, "Skylight".
#pragma once
#include <array>

#include "kernels_cpu/raymarch/raymarch_params.h"
#include "src/plan/array.h"
#include "src/run/context.h"
#include "src/world/light/lights.h"
#include "src/world/majorant/majorants.h"

namespace pileus {

/// `light` is [set][node], 0 to 1 where a set's colour is the light of a whole sphere of it.
struct SkyNodes {
    NodeGrid grid{};
    int sets = 0;
    float colour[3][3] = {};
    Buffer<float> light;
    Buffer<float> seen;  ///< [part of the sphere][node]: share of its light that comes through
};

/// Nodes that make_sky_nodes would make, at most about 2^15, and its sets: constant sky and ground
/// are one each, a map has one for each channel with the ground in it.
NodeGrid sky_node_grid(const Medium& medium);
int sky_node_sets(const Lighting& lighting);

/// Middles of equal parts of the sphere, the lower half first: unit vectors.
constexpr int kSkyParts = 24;
std::array<float, 3> sky_direction(int part);

namespace arrays {

/// Of each set; `last` marches.
inline Array<float> sky_light(std::uint64_t nodes, int sets, Stage last) {
    return {"skylight on nodes", bytes_of(nodes, std::uint64_t(sets)), Stage::kShadow, last};
}
/// From each part of the sphere.
inline Array<float> sky_seen(std::uint64_t nodes) {
    return {"sky seen from nodes", bytes_of(kSkyParts, nodes), Stage::kShadow, Stage::kWrite};
}

}  // namespace arrays

/// Light from directions all around, each weakened by what it passes; forward scattering keeps
/// `kept` of what is scattered; octaves add up, to no more than there is. What nodes see through
/// the media is made where `out` does not hold it, so that it serves every sun. kLimit: out of
/// memory.
Status make_sky_nodes(const Context& context, const Medium& medium, const Majorants& majorants,
                      const Lighting& lighting, double kept, const Octaves& octaves, SkyNodes& out);

}  // namespace pileus
