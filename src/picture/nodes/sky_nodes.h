// SPDX-License-Identifier: Apache-2.0
// Skylight that reaches nodes over the medium, from a few directions: an approximation.
// in: a medium, sky and ground -> out: brightness per node in sets of one colour each.
// docs/raymarch.md, "Skylight".
#pragma once
#include "src/picture/nodes/sky_view.h"
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
    Buffer<float> seen;  ///< [number][node], sky_seen_numbers of them
    SkyPhase phase{};    ///< where a camera looks
};

/// Nodes that make_sky_nodes would make, at most about 2^15, and its sets: constant sky and ground
/// are one each, a map has one for each channel with the ground in it.
NodeGrid sky_node_grid(const Medium& medium);
int sky_node_sets(const Lighting& lighting);

namespace arrays {

/// Of each set; `last` marches.
inline Array<float> sky_light(std::uint64_t nodes, int sets, Stage last) {
    return {"skylight on nodes", bytes_of(nodes, std::uint64_t(sets)), Stage::kShadow, last};
}
inline Array<float> sky_seen(std::uint64_t nodes, int numbers) {
    return {"sky seen from nodes", bytes_of(std::uint64_t(numbers), nodes), Stage::kShadow,
            Stage::kWrite};
}

}  // namespace arrays

/// Light from directions all around, each weakened by what it passes; forward scattering keeps
/// `kept` of what is scattered; octaves add up, to no more than there is. What nodes see through
/// the media is made where `out` does not hold it, so that it serves every sun and camera. kLimit:
/// out of memory.
Status make_sky_nodes(const Context& context, const Medium& medium, const Majorants& majorants,
                      const Lighting& lighting, double kept, const Octaves& octaves,
                      const SkyView& view, SkyNodes& out);

}  // namespace pileus
