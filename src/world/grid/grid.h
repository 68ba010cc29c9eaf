// SPDX-License-Identifier: Apache-2.0
// A box of voxels: how many, how large, and where each is in an array.
// in: nothing -> out: plain struct, read only once it is made.
// docs/methods.md 1; lengths are box-local: metres from the low corner of the box.
#pragma once
#include <cstddef>
#include <cstdint>

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

}  // namespace pileus
