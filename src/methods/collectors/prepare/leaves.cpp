// SPDX-License-Identifier: Apache-2.0
// See leaves.h.
// in: leaves as boxes, densities -> out: the leaves' numbers, their index in each voxel.
// Elek 2011, section 5.4.
#include "src/methods/collectors/prepare/leaves.h"

#include <algorithm>

#include "platform/threads.h"
#include "src/base/buffer.h"
#include "src/world/grid/grid.h"

namespace pileus {
namespace {

constexpr std::size_t kChunk = 32;

template <class Function>
void for_each_leaf(int threads, std::size_t count, Function&& work) {
    parallel_for(threads, std::int64_t((count + kChunk - 1) / kChunk),
                 [&](std::int64_t c, int thread) {
                     const std::size_t begin = std::size_t(c) * kChunk;
                     for (std::size_t l = begin; l < std::min(begin + kChunk, count); ++l)
                         work(l, thread);
                 });
}

/// Largest density that the trilinear field can touch inside the leaf.
float footprint_max(Span<const float> density, const Grid& grid, const Leaf& leaf) {
    int lo[3], hi[3];
    for (int a = 0; a < 3; ++a) {
        lo[a] = std::max(int(leaf.lo[a]) - 1, 0);
        hi[a] = std::min(int(leaf.hi[a]) + 1, grid.size[a]);
    }
    float largest = 0.0f;
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j) {
            const float* row = density.data + voxel_index(grid, 0, j, k);
            for (int i = lo[0]; i < hi[0]; ++i) largest = row[i] > largest ? row[i] : largest;
        }
    return largest;
}

/// `row` has room for the longest row of a leaf.
void measure(Span<const float> density, const Grid& grid, double* row, Leaf& leaf, LeafMoments& m) {
    leaf.majorant = footprint_max(density, grid, leaf);
    leaf.mass = 0;
    leaf.filled = 0.0f;
    if (!(leaf.majorant > 0.0f)) return;
    for (int a = 0; a < 3; ++a) m.lo[a] = leaf.hi[a], m.hi[a] = leaf.lo[a];
    std::int64_t filled = 0, voxels = 1;
    for (int a = 0; a < 3; ++a) voxels *= leaf.hi[a] - leaf.lo[a];
    for (int k = leaf.lo[2]; k < leaf.hi[2]; ++k)
        for (int j = leaf.lo[1]; j < leaf.hi[1]; ++j) {
            mass_row(density, grid, {leaf.lo[0], leaf.hi[0]}, j, k, row);
            const float* values = density.data + voxel_index(grid, 0, j, k);
            for (int i = leaf.lo[0]; i < leaf.hi[0]; ++i) {
                const double mass = row[i - leaf.lo[0]];
                filled += values[i] > 0.0f;
                if (!(mass > 0)) continue;
                leaf.mass += mass;
                const std::int32_t voxel[3] = {i, j, k};
                for (int a = 0; a < 3; ++a) {
                    m.lo[a] = std::min(m.lo[a], voxel[a]);
                    m.hi[a] = std::max<std::int32_t>(m.hi[a], voxel[a] + 1);
                    m.first[a] += mass * (double(voxel[a] - leaf.lo[a]) + 0.5);
                }
            }
        }
    leaf.filled = float(double(filled) / double(voxels));
}

}  // namespace

Status measure_leaves(Span<const float> density, const Grid& grid, int threads, Span<Leaf> leaves,
                      Span<LeafMoments> moments) {
    assert(density.size == voxel_count(grid) && moments.size == leaves.size);
    const std::size_t nx = std::size_t(grid.size[0]);
    Buffer<double> rows;
    PILEUS_TRY(allocate(arrays::row_masses(grid, threads > 1 ? std::uint64_t(threads) : 1), rows));
    for_each_leaf(threads, leaves.size, [&](std::size_t l, int thread) {
        moments[l] = LeafMoments{};
        measure(density, grid, rows.data() + nx * std::size_t(thread), leaves[l], moments[l]);
    });
    return Status::ok();
}

void fill_leaf_grid(Span<const Leaf> leaves, const Grid& grid, int threads, LeafLabel label,
                    Span<std::int32_t> of_voxel) {
    assert(of_voxel.size == voxel_count(grid));
    for_each_leaf(threads, leaves.size, [&](std::size_t l, int) {
        const Leaf& leaf = leaves[l];
        const std::int32_t own = label == LeafLabel::kLeaf ? std::int32_t(l) : leaf.collector;
        for (int k = leaf.lo[2]; k < leaf.hi[2]; ++k)
            for (int j = leaf.lo[1]; j < leaf.hi[1]; ++j) {
                std::int32_t* row = of_voxel.data + voxel_index(grid, 0, j, k);
                std::fill(row + leaf.lo[0], row + leaf.hi[0], own);
            }
    });
}

}  // namespace pileus
