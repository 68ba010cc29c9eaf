// SPDX-License-Identifier: Apache-2.0
// Walks an OpenVDB tree of numbers: which voxels are active, then their values.
// in: a grid found by vdb_grid.h -> out: the box of its active voxels; the dense values in it.
// docs/formats.md
#pragma once
#include "src/io/volumes/vdb/vdb_box.h"
#include "src/io/volumes/vdb/vdb_grid.h"

namespace pileus {

/// Walks the masks and tiles of a grid that choose_vdb_grid gave.
Status measure_vdb_tree(ByteCursor& in, const VdbGrid& grid, VdbBox& box);

/// Writes tiles and voxels into `volume`, whose size is the box's and whose values are 0.
Status fill_vdb_tree(ByteCursor& in, const VdbGrid& grid, const VdbBox& box, Volume& volume);

}  // namespace pileus
