// SPDX-License-Identifier: Apache-2.0
// kD-tree over the samples: boxes of similar density, fine where the density changes.
// in: samples, densities -> out: leaves as boxes of whole voxels that tile the grid.
// Elek 2011, section 5.3 and figure 5.4; docs/methods.md 3, prepare 3.
#pragma once
#include <string>

#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/methods/collectors/prepare/prepared.h"
#include "src/plan/array.h"
#include "src/world/grid/grid.h"

namespace pileus {

struct TreeOptions {
    float density_range = 0.1f;          ///< a node whose samples differ by less is not split
    float influence_m = 0;               ///< radius of influence of a sample; 0: no finalisation
    int max_leaf_voxels[3] = {0, 0, 0};  ///< halve leaves with medium that are longer; 0: off
    int max_face_voxels[3] = {0, 0, 0};  ///< those at a face of the grid where light comes in
    std::uint64_t max_leaves = 0x7fffffff;
    std::string where = "kD-tree";  ///< opens the line about too many leaves
};

namespace arrays {

inline Array<Leaf> leaves(std::uint64_t count) {
    return {"leaves", count, Stage::kTree, Stage::kWrite};
}

}  // namespace arrays

/// What the tree takes while it is built, for so many samples and at most so many leaves.
void add_tree_rows(const Grid& grid, std::uint64_t samples, std::uint64_t leaves,
                   MemoryTable& table);

/// Longest leaf allowed on each axis so that no leaf spans more than `share` of the box's diagonal
/// (docs/methods.md 3 resolves the light inside uniform regions this way), nor, where the box is
/// flat, more than a twelfth of its edge, unless that is less than two optical depths of
/// `extinction_per_m`. At least one voxel.
void leaf_limit(const Grid& grid, double share, double extinction_per_m, int max_leaf_voxels[3]);

/// The same of leaves at a face of the box, where a medium may end all at once and no sample tells
/// of it: two optical depths where that is less, but no less than a quarter of `inside`, nor than
/// what leaves each of them some of so many photons.
void face_leaf_limit(const Grid& grid, double extinction_per_m, std::int64_t photons,
                     const int (&inside)[3], int (&face)[3]);

/// Recommended share of the diagonal for `leaf_limit`. Halving alone then makes at most 16^3 leaves
/// of a filled cube, a fifth of the default number of samples, and halves the mean edge of the
/// leaves of a uniform ball.
constexpr double kLeafShare = 1.0 / 24;

/// Leaves that a tree is expected to have at most, and is held to unless told otherwise: four a
/// sample, eight times what halving down to `share` makes of a filled box, and twice what finer
/// halving makes of its faces; never more than voxels. Clouds have 0.7 to 1.4 a sample, noise in
/// every voxel a third of this bound (docs/report.md).
std::uint64_t expected_leaves(const Grid& grid, double share, double extinction_per_m,
                              std::int64_t photons, std::uint64_t samples);

/// Builds the leaves, lo and hi only, in the order of a walk that takes the lower half first.
/// O(n log n) in the samples. `density_range` is in units of density: the caller multiplies the
/// user's share by the largest density. kLimit: out of memory or more than
/// options.max_leaves.
Status build_tree(Span<const Sample> samples, Span<const float> density, const Grid& grid,
                  const TreeOptions& options, int threads, Buffer<Leaf>& leaves);

}  // namespace pileus
