// SPDX-License-Identifier: Apache-2.0
// In place of the header of that path: without meshes nothing throws this shadow.
// in: nothing -> out: nothing. docs/flight.md, "Build"
#pragma once
#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/picture/nodes/node_grid.h"
#include "src/world/solids/solids.h"

namespace pileus {

inline Status solid_visibility(const Context&, const Solids&, const NodeGrid&,
                               const std::array<float, 3>&, Buffer<float>&) {
    return Status::ok();
}

}  // namespace pileus
