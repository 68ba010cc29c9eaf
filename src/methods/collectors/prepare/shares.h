// SPDX-License-Identifier: Apache-2.0
// How much of each collector's extinction belongs to each medium.
// in: leaves, the densities of the parts -> out: shares, which the reconstruction mixes by.
// docs/methods.md 2, "Several media".
#pragma once
#include "src/methods/collectors/prepare/prepared.h"
#include "src/plan/array.h"
#include "src/world/grid/grid.h"
#include "src/world/medium/medium.h"

namespace pileus {

namespace arrays {

inline Array<double> part_masses(const Grid& grid) {
    return {"voxel masses of a part", voxel_count(grid), Stage::kLeafGrid, Stage::kLeafGrid};
}
inline Array<float> shares(std::uint64_t collectors, std::uint64_t media) {
    return {"shares of the media", bytes_of(collectors, media), Stage::kLeafGrid, Stage::kWrite};
}

}  // namespace arrays

/// Fills `shares`: [collector][medium], in [0, 1], adding up to 1 but for rounding. Takes 8 bytes a
/// voxel meanwhile. kLimit: out of memory.
Status measure_shares(const Medium& medium, Span<const Leaf> leaves,
                      Span<const Collector> collectors, int threads, Buffer<float>& shares);

}  // namespace pileus
