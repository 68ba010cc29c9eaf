// SPDX-License-Identifier: Apache-2.0
// A regular grid of relative densities as the readers and the procedural makers hand it over.
// in: a file or parameters -> out: nx*ny*nz floats, x fastest, z up, cell-centred.
// docs/methods.md 1, docs/formats.md.
#pragma once
#include <array>
#include <cstdint>

#include "src/base/buffer.h"

namespace pileus {

struct Volume {
    std::array<int, 3> size{0, 0, 0};                 ///< cells along x, y, z; each 1..4096
    Buffer<float> density;                            ///< index (z*ny + y)*nx + x; finite, >= 0
    bool knows_bounds = false;                        ///< the file says where its box lies
    std::array<std::array<double, 3>, 2> bounds_m{};  ///< outer faces of the box, metres
};

}  // namespace pileus
