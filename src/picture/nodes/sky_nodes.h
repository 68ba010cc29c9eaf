// SPDX-License-Identifier: Apache-2.0
// Skylight that reaches nodes over the medium, from a few directions: an approximation.
// in: a medium, sky and ground -> out: brightness per node in sets of one colour each.
// docs/raymarch.md, "Skylight".
#pragma once
#include "kernels_cpu/raymarch/raymarch_params.h"
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
};

/// Nodes that make_sky_nodes would make, at most about 2^15, and its sets: constant sky and ground
/// are one each, a map has one for each channel with the ground in it.
NodeGrid sky_node_grid(const Medium& medium);
int sky_node_sets(const Lighting& lighting);

/// Light from directions all around, each weakened by what it passes; forward scattering keeps
/// `kept` of what is scattered; octaves add up, to no more than there is. kLimit: out of memory.
Status make_sky_nodes(const Context& context, const Medium& medium, const Majorants& majorants,
                      const Lighting& lighting, double kept, const Octaves& octaves, SkyNodes& out);

}  // namespace pileus
