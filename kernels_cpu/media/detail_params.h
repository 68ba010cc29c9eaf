// SPDX-License-Identifier: Apache-2.0
// Detail beyond the grid: a tile of noise that repeats over a medium, as kernels read it.
// in: a scene's detail -> out: the layout of a launch. Filled by src/world/medium/detail.cpp.
// docs/detail.md
#pragma once
#include <cstdint>

namespace pileus {

struct DetailView {
    const float* tile;   ///< (cells + 1)^3 numbers >= -1, x fastest; the last repeat the first
    std::int32_t cells;  ///< along each edge
    float period[3];     ///< m after which it repeats
    float per_metre[3];  ///< cells per metre
    float strength;      ///< 0..1
    float core;          ///< how much of it one unit of density takes away
};

}  // namespace pileus
