// SPDX-License-Identifier: Apache-2.0
// Walks an OpenVDB tree of numbers: which voxels are active, then their values.
// in: a grid found by vdb_grid.h -> out: the box of its active voxels; the dense values in it.
// docs/formats.md
#pragma once
#include "src/io/vdb_grid.h"
#include "src/io/volume.h"

namespace pileus {

/// Voxel indices of the file, both ends included; empty while low > high.
struct VdbBox {
    std::array<std::int64_t, 3> low{1, 1, 1}, high{0, 0, 0};
    std::uint64_t active = 0;     ///< active voxels, those of tiles included
    std::uint64_t values_at = 0;  ///< where the voxels' values begin in the file
    bool empty() const { return low[0] > high[0]; }
};

/// Walks the masks and tiles of a grid that choose_vdb_grid gave.
Status measure_vdb_tree(ByteCursor& in, const VdbGrid& grid, VdbBox& box);

/// Writes tiles and voxels into `volume`, whose size is the box's and whose values are 0.
Status fill_vdb_tree(ByteCursor& in, const VdbGrid& grid, const VdbBox& box, Volume& volume);

}  // namespace pileus
