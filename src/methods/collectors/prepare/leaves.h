// SPDX-License-Identifier: Apache-2.0
// What each leaf holds, and in which leaf each voxel lies.
// in: leaves as boxes, densities -> out: the leaves' numbers, their index in each voxel.
// Elek 2011, section 5.4; docs/methods.md 3, prepare 3-4.
#pragma once
#include "src/base/span.h"
#include "src/base/status.h"
#include "src/methods/collectors/prepare/prepared.h"
#include "src/plan/array.h"
#include "src/world/grid/grid.h"

namespace pileus {

/// Where the mass of a leaf lies; all zero where it has none.
struct LeafMoments {
    double first[3];            ///< sum of mass times voxels from lo to the voxel's centre, m^3
    std::int32_t lo[3], hi[3];  ///< bounds of the voxels with mass, faces, half-open
};

namespace arrays {

inline Array<LeafMoments> leaf_moments(std::uint64_t leaves) {
    return {"moments of leaves", leaves, Stage::kCollectors, Stage::kLeafGrid};
}
/// Masses of a row of voxels, per thread.
inline Array<double> row_masses(const Grid& grid, std::uint64_t threads) {
    return {"moments of leaves", bytes_of(std::uint64_t(grid.size[0]), threads), Stage::kCollectors,
            Stage::kLeafGrid};
}
/// Lives as long as photons are traced.
inline Array<std::int32_t> collector_of_voxel(const Grid& grid, Stage last) {
    return {"collector of voxel", voxel_count(grid), Stage::kLeafGrid, last};
}

}  // namespace arrays

/// Fills majorant (density, one-voxel border included), mass (m^3) and filled of every leaf, and
/// `moments`, one per leaf. The masses of all leaves add up to the volume's but for double
/// rounding. kLimit: out of memory.
Status measure_leaves(Span<const float> density, const Grid& grid, int threads, Span<Leaf> leaves,
                      Span<LeafMoments> moments);

/// What a voxel of the grid holds: the index of its leaf, or of its leaf's collector.
enum class LeafLabel { kLeaf, kCollector };

/// Writes each voxel's label; the leaves tile the grid.
void fill_leaf_grid(Span<const Leaf> leaves, const Grid& grid, int threads, LeafLabel label,
                    Span<std::int32_t> of_voxel);

}  // namespace pileus
