// SPDX-License-Identifier: Apache-2.0
// The shadow of solids in the media: on nodes, the share of them that the sun reaches.
// in: solids, nodes over the box, the sun's direction -> out: 0 to 1 for each node.
// docs/solids.md, "Shadows in clouds".
#pragma once
#include "src/world/solids/solids.h"

namespace pileus {

/// Eight rays a node, from the middles of its eighths; read trilinearly. Leaves `out` empty where
/// there are no triangles. kLimit: out of memory.
Status solid_visibility(const Context& context, const Solids& solids, const NodeGrid& nodes,
                        const std::array<float, 3>& to_sun, Buffer<float>& out);

}  // namespace pileus
