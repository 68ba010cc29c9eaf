// SPDX-License-Identifier: Apache-2.0
// See prepare_leaves.h.
// in: leaves as boxes, densities, masses -> out: the leaves' numbers, a leaf index per voxel.
// Elek 2011, section 5.4.
#include "src/stages/prepare_leaves.h"

#include <algorithm>

#include "platform/threads.h"

namespace pileus {
namespace {

constexpr std::size_t kChunk = 32;

template <class Function>
void for_each_leaf(int threads, std::size_t count, Function&& work) {
    parallel_for(threads, std::int64_t((count + kChunk - 1) / kChunk), [&](std::int64_t c, int) {
        const std::size_t begin = std::size_t(c) * kChunk;
        for (std::size_t l = begin; l < std::min(begin + kChunk, count); ++l) work(l);
    });
}

/// Largest density that the trilinear field can touch inside the leaf.
float footprint_max(Span<const float> density, const Grid& grid, const Leaf& leaf) {
    int lo[3], hi[3];
    for (int a = 0; a < 3; ++a) {
        lo[a] = std::max(leaf.lo[a] - 1, 0);
        hi[a] = std::min(leaf.hi[a] + 1, grid.size[a]);
    }
    float largest = 0.0f;
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j) {
            const float* row = density.data + voxel_index(grid, 0, j, k);
            for (int i = lo[0]; i < hi[0]; ++i) largest = row[i] > largest ? row[i] : largest;
        }
    return largest;
}

void measure(Span<const float> density, Span<const double> masses, const Grid& grid, Leaf& leaf) {
    leaf.majorant = footprint_max(density, grid, leaf);
    leaf.mass = 0;
    leaf.filled = 0.0f;
    if (!(leaf.majorant > 0.0f)) return;
    std::int64_t filled = 0, voxels = 1;
    for (int a = 0; a < 3; ++a) voxels *= leaf.hi[a] - leaf.lo[a];
    for (int k = leaf.lo[2]; k < leaf.hi[2]; ++k)
        for (int j = leaf.lo[1]; j < leaf.hi[1]; ++j) {
            const std::size_t row = voxel_index(grid, 0, j, k);
            for (std::size_t v = row + std::size_t(leaf.lo[0]); v < row + std::size_t(leaf.hi[0]);
                 ++v) {
                leaf.mass += masses[v];
                filled += density[v] > 0.0f;
            }
        }
    leaf.filled = float(double(filled) / double(voxels));
}

}  // namespace

void measure_leaves(Span<const float> density, Span<const double> masses, const Grid& grid,
                    int threads, Span<Leaf> leaves) {
    assert(density.size == voxel_count(grid) && masses.size == density.size);
    for_each_leaf(threads, leaves.size,
                  [&](std::size_t l) { measure(density, masses, grid, leaves[l]); });
}

void fill_leaf_grid(Span<const Leaf> leaves, const Grid& grid, int threads,
                    Span<std::int32_t> leaf_of_voxel) {
    assert(leaf_of_voxel.size == voxel_count(grid));
    for_each_leaf(threads, leaves.size, [&](std::size_t l) {
        const Leaf& leaf = leaves[l];
        for (int k = leaf.lo[2]; k < leaf.hi[2]; ++k)
            for (int j = leaf.lo[1]; j < leaf.hi[1]; ++j) {
                std::int32_t* row = leaf_of_voxel.data + voxel_index(grid, 0, j, k);
                std::fill(row + leaf.lo[0], row + leaf.hi[0], std::int32_t(l));
            }
    });
}

}  // namespace pileus
