// SPDX-License-Identifier: Apache-2.0
// What the preparation of method `collectors` leaves behind: samples, leaves, collectors.
// in: nothing -> out: plain structs, made once per animation frame, then read only.
// Elek 2011, sections 5.1-5.5; lengths are box-local: metres from the low corner of the box.
#pragma once
#include <cstddef>
#include <cstdint>

namespace pileus {

/// A box of voxels. Voxel (i, j, k) has its centre at (i+0.5, j+0.5, k+0.5) * cell_m and the array
/// index (k*size[1] + j)*size[0] + i. "Voxel coordinates" are metres divided by cell_m.
struct Grid {
    int size[3];            ///< voxels along x, y, z; each 1..4096
    float cell_m[3];        ///< edge lengths of a voxel, metres; each > 0
    bool periodic = false;  ///< the box repeats without end along x and y
};

inline std::size_t voxel_index(const Grid& grid, int i, int j, int k) {
    return (std::size_t(k) * std::size_t(grid.size[1]) + std::size_t(j)) *
               std::size_t(grid.size[0]) +
           std::size_t(i);
}

inline std::size_t voxel_count(const Grid& grid) { return voxel_index(grid, 0, 0, grid.size[2]); }

/// A point drawn where the density changes.
struct Sample {
    float x[3];     ///< voxel coordinates, inside the box, never on a voxel's face
    float density;  ///< trilinear, at x
};

/// A box of whole voxels; all leaves together tile the grid.
struct Leaf {
    std::int32_t lo[3], hi[3];  ///< voxel faces, half-open
    float majorant;             ///< largest density over the trilinear footprint
    double mass;                ///< integral of the trilinear density over the leaf, m^3
    float filled;               ///< share of voxels that are not empty, [0, 1]
    std::int32_t collector;     ///< index, or -1 where the mass is 0
};

/// A sphere that stands for the medium of one leaf.
struct Collector {
    float centre[3];         ///< metres, box-local
    float radius;            ///< of the sphere with the leaf's volume, metres
    float billboard_radius;  ///< R >= radius, metres
    float extinction;        ///< mass / (4/3 pi R^3): relative density of the billboard
    double mass;             ///< of the leaf, m^3
    std::int32_t leaf;
};

}  // namespace pileus
