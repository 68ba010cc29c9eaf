// SPDX-License-Identifier: Apache-2.0
// Densities carried from their own voxels onto another grid, whose cells hold what theirs held.
// in: media with boxes and voxels of their own -> out: extinctions added up on the target's grid.
// docs/methods.md 2, "Several media".
#pragma once
#include "src/world/grid/grid.h"
#include "src/world/medium/medium.h"
#include "src/world/medium/mix_media.h"

namespace pileus {

inline MixBox box_of(const Medium& m) {
    return {m.low_m, {m.extent_m[0], m.extent_m[1], m.extent_m[2]}, m.volume.size};
}

inline CellRow row_of(const MixBox& box, std::size_t axis) {
    return {box.low_m[axis], box.extent_m[axis] / box.size[axis], box.size[axis]};
}

/// One medium on its way onto the grid: weights per axis, and the common unit of extinction.
struct Layer {
    const Medium* medium;
    RowWeights axis[3];
    double scale;
    float* part;  ///< null for medium 0, which the sum holds

    std::size_t width() const { return std::size_t(medium->volume.size[0]); }
    std::size_t plane() const { return width() * std::size_t(medium->volume.size[1]); }
};

/// `sigma`: the target's extinction at density 1; `part`: where its densities go apart, or null.
Layer make_layer(const Medium& medium, const MixBox& target, float sigma, float* part);

/// Adds all layers to the density of `out`, which is that of `box` and zero before. kLimit: out of
/// memory.
Status add_layers(const std::vector<Layer>& layers, const MixBox& box, int threads, Medium& out);

/// The same box in `size` cells, each holding the mean of the density over it: what lies
/// in the box stays the same. Its density alone: optics and parts are left out. `density` names
/// the array in the plan. kLimit: out of memory.
Status resample_medium(const Medium& medium, const std::array<int, 3>& size, int threads,
                       const Array<float>& density, Medium& out);

/// The grid that it has.
Grid resampled_grid(const Medium& medium, const std::array<int, 3>& size);

}  // namespace pileus
