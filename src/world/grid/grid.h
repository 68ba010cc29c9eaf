// SPDX-License-Identifier: Apache-2.0
// A box of voxels: how many, how large, and where each is in an array.
// in: nothing -> out: plain struct, read only once it is made.
// docs/methods.md 1; lengths are box-local: metres from the low corner of the box.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/base/span.h"

namespace pileus {

/// A box of voxels. Voxel (i, j, k) has its centre at (i+0.5, j+0.5, k+0.5) * cell_m and the array
/// index (k*size[1] + j)*size[0] + i. "Voxel coordinates" are metres divided by cell_m.
struct Grid {
    int size[3];            ///< voxels along x, y, z; each 1 or more
    float cell_m[3];        ///< edge lengths of a voxel, metres; each > 0
    bool periodic = false;  ///< the box repeats without end along x and y
    bool constant = false;  ///< a voxel has one density; else it is linear between centres
};

inline std::size_t voxel_index(const Grid& grid, int i, int j, int k) {
    return (std::size_t(k) * std::size_t(grid.size[1]) + std::size_t(j)) *
               std::size_t(grid.size[0]) +
           std::size_t(i);
}

inline std::size_t voxel_count(const Grid& grid) { return voxel_index(grid, 0, 0, grid.size[2]); }

/// Smallest edge of a voxel, m.
inline float smallest_cell(const Grid& grid) {
    float smallest = grid.cell_m[0];
    for (float cell : grid.cell_m) smallest = cell < smallest ? cell : smallest;
    return smallest;
}

// The density between grid points and its exact integrals, its one meaning in the preparation:
// linear between centres and clamped inside the box, or constant within voxels (Grid::constant);
// zero outside.

/// Density at a point inside the box, given in voxel coordinates [0, size].
float density_at(Span<const float> density, const Grid& grid, const float x[3]);

/// Integral of the density over voxels [range[0], range[1]) of row (j, k), m^3 each.
void mass_row(Span<const float> density, const Grid& grid, const int (&range)[2], int j, int k,
              double* out);

/// The same of every voxel, into `masses` (one per voxel). Exact but for double rounding; the same
/// for any number of threads.
void voxel_masses(Span<const float> density, const Grid& grid, int threads, Span<double> masses);

// Weights that carry a row of voxels onto another lattice and keep what it holds: the mean of the
// trilinear field over each target cell. docs/methods.md 2, "Several media".

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
