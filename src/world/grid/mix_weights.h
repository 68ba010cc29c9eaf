// SPDX-License-Identifier: Apache-2.0
// Weights that carry a row of voxels onto another lattice and keep what it holds.
// in: two rows of cells along one axis -> out: per target cell, weights of a run of source cells.
// docs/methods.md 2, "Several media": the mean of the trilinear field over each target cell.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pileus {

/// Cells [0, count) of edge `cell_m`, the first one beginning at `low_m`.
struct CellRow {
    double low_m, cell_m;
    int count;
};

/// Target cell t is the sum of weight[first[t] + k] times source cell begin[t] + k, over all k with
/// first[t] + k < first[t + 1].
struct RowWeights {
    std::vector<int> begin;
    std::vector<std::size_t> first;
    std::vector<double> weight;
    bool resampled = false;  ///< some target cell is not simply a source cell
};

/// Exact: the source is read trilinearly, held constant over half a cell at both ends of its row,
/// and zero beyond; where its cells are `constant`, these hold all over themselves. A lattice that
/// coincides with the target's (within a millionth of a cell) is copied. The target must cover the
/// source; then weights times target cells add up to the source cell for each of them.
RowWeights row_weights(const CellRow& target, const CellRow& source, bool constant = false);

}  // namespace pileus
