// SPDX-License-Identifier: Apache-2.0
// What a tracker needs of the medium: its grid, its bounds and how long it may go on.
// in: the prepared arrays -> out: the layout that a CPU or GPU launch takes.
// docs/methods.md 2. Lengths in metres, box-local; positions inside the kernel in voxels.
#pragma once
#include <cstdint>

namespace pileus {

struct TrackGrid {
    std::int32_t size[3];      ///< voxels
    float cell[3];             ///< voxel edges, m
    std::int32_t blocks[3];    ///< majorant blocks
    float block;               ///< block edge, voxels
    float sigma;               ///< extinction at density 1, 1/m
    std::int32_t periodic;     ///< 1: the grid repeats without end along x and y
    std::int32_t constant;     ///< 1: a voxel has one density; 0: trilinear between centres
    std::uint32_t max_events;  ///< draws per ray before it is given up
    const float* density;      ///< voxels, x fastest, >= 0
    const float* majorant;     ///< blocks, bound on the density over the trilinear footprint
};

}  // namespace pileus
