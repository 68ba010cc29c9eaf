// SPDX-License-Identifier: Apache-2.0
// See leaf_list.h.
// in: a box and the bounds of its samples -> out: one or more leaves that tile the box.
// Elek 2011, figure 5.4.
#include "src/methods/collectors/prepare/leaf_list.h"

#include <algorithm>
#include <cmath>

#include "src/base/limits.h"
#include "src/picture/nodes/node_grid.h"

namespace pileus {
namespace {

/// A slab that may be cut off: on the low or high side of `axis`, at voxel face `face`.
struct Cut {
    int axis = -1;
    bool low = false;
    std::int32_t face = 0;
    double gap_m = 0;
};

/// Keeps the wider of `best` and the slab on one side, if a whole voxel can be cut there.
void consider(const VoxelBox& box, const SampleBounds& bounds, const Grid& grid, double radius_m,
              int axis, bool low, Cut& best) {
    const double cell = double(grid.cell_m[axis]);
    const double edge = low ? double(bounds.lo[axis]) : double(bounds.hi[axis]);
    const double gap = (low ? edge - box.lo[axis] : box.hi[axis] - edge) * cell;
    if (!(gap > radius_m) || !(gap > best.gap_m)) return;
    // Snap away from the samples; both limits lie inside the box, so they are not negative.
    const double limit = low ? edge - radius_m / cell : edge + radius_m / cell;
    std::int32_t face = std::int32_t(limit);
    if (!low && limit > double(face)) ++face;
    if (face <= box.lo[axis] || face >= box.hi[axis]) return;
    best = {axis, low, face, gap};
}

/// Pieces that halving makes of an edge, until none is longer than so many voxels.
std::uint64_t halved(double edge, int voxels) {
    std::uint64_t pieces = 1;
    for (; edge > voxels; edge /= 2) pieces *= 2;
    return pieces;
}

/// Leaves of so many voxels that halving makes of all faces of a grid.
std::uint64_t leaves_of_faces(const Grid& grid, const int (&voxels)[3]) {
    std::uint64_t n[3];
    for (int a = 0; a < 3; ++a) n[a] = halved(grid.size[a], voxels[a]);
    return 2 * (n[0] * n[1] + n[1] * n[2] + n[2] * n[0]);
}

}  // namespace

void leaf_limit(const Grid& grid, double share, double extinction_per_m, int max_leaf_voxels[3]) {
    double square = 0;
    for (int a = 0; a < 3; ++a) {
        const double edge = double(grid.size[a]) * double(grid.cell_m[a]);
        square += edge * edge;
    }
    for (int a = 0; a < 3; ++a) {
        const double edge = double(grid.size[a]) * double(grid.cell_m[a]);
        const double layers = std::max(1.0, layers_of_depth(edge * extinction_per_m, 12));
        const double longest = std::min(std::sqrt(square) * share, edge / layers);
        const double voxels = longest / double(grid.cell_m[a]);
        const double inside = std::min(std::max(voxels, 1.0), double(grid.size[a]));
        max_leaf_voxels[a] = int(inside + 0.5);
    }
}

void face_leaf_limit(const Grid& grid, double extinction_per_m, std::int64_t photons,
                     const int (&inside)[3], int (&face)[3]) {
    constexpr double kDepth = 2, kPhotonsPerLeaf = 8, kFewest = 512;
    const double most = std::max(kFewest, double(photons) / kPhotonsPerLeaf);
    for (double wider = 1;; wider *= 1.25) {
        bool same = true;
        for (int a = 0; a < 3; ++a) {
            const double depth = kDepth / (extinction_per_m * double(grid.cell_m[a]));
            const double voxels = wider * std::max(depth, double(inside[a]) / 4);
            face[a] = voxels < inside[a] ? std::max(int(voxels + 0.5), 1) : inside[a];
            same &= face[a] == inside[a];
        }
        if (same || double(leaves_of_faces(grid, face)) <= most) return;
    }
}

std::uint64_t expected_leaves(const Grid& grid, double share, double extinction_per_m,
                              std::int64_t photons, std::uint64_t samples) {
    int longest[3], at_face[3];
    leaf_limit(grid, share, extinction_per_m, longest);
    face_leaf_limit(grid, extinction_per_m, photons, longest, at_face);
    std::uint64_t inside = 1;
    for (int a = 0; a < 3; ++a) inside *= halved(grid.size[a], longest[a]);
    const std::uint64_t faces = 2 * leaves_of_faces(grid, at_face);
    return std::min<std::uint64_t>(4 * samples + 8 * inside + faces, voxel_count(grid));
}

Status LeafList::append(const VoxelBox& box) {
    if (count_ >= options_.max_leaves) {
        Limits limits;
        limits[LimitId::kLeaves] = options_.max_leaves;
        return check_limit(limits, LimitId::kLeaves, count_ + 1, options_.where);
    }
    if (count_ == leaves_.size()) {
        Buffer<Leaf> larger;
        const std::size_t wanted = std::max<std::size_t>(1024, 2 * count_);
        PILEUS_TRY(allocate(
            arrays::growing_leaves(std::min<std::uint64_t>(wanted, options_.max_leaves)), larger));
        std::copy(leaves_.data(), leaves_.data() + count_, larger.data());
        leaves_.swap(larger);
    }
    Leaf leaf{};
    for (int a = 0; a < 3; ++a) leaf.lo[a] = box.lo[a], leaf.hi[a] = box.hi[a];
    leaf.collector = -1;
    leaves_[count_++] = leaf;
    return Status::ok();
}

bool LeafList::holds_medium(const VoxelBox& box) const {
    // Include the one-voxel border: the trilinear field reaches half a voxel into it.
    int lo[3], hi[3];
    for (int a = 0; a < 3; ++a) {
        lo[a] = std::max(int(box.lo[a]) - 1, 0);
        hi[a] = std::min(int(box.hi[a]) + 1, grid_.size[a]);
    }
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j) {
            const float* row = density_.data + voxel_index(grid_, 0, j, k);
            for (int i = lo[0]; i < hi[0]; ++i)
                if (row[i] > 0.0f) return true;
        }
    return false;
}

bool LeafList::at_face(const VoxelBox& box) const {
    for (int a = grid_.periodic ? 2 : 0; a < 3; ++a)
        if (box.lo[a] == 0 || box.hi[a] == grid_.size[a]) return true;
    return false;
}

int LeafList::axis_too_long(const VoxelBox& box) const {
    int axis = -1;
    double worst = 1.0;
    const bool fine = options_.max_face_voxels[0] > 0 && at_face(box);
    for (int a = 0; a < 3; ++a) {
        const int limit = fine ? options_.max_face_voxels[a] : options_.max_leaf_voxels[a];
        if (limit <= 0) continue;
        const double ratio = double(box.hi[a] - box.lo[a]) / double(limit);
        if (ratio > worst) worst = ratio, axis = a;
    }
    return axis;
}

Status LeafList::add(const VoxelBox& box) {
    // Halving an edge of at most 4096 voxels ends after 12 steps per axis, and the walk keeps one
    // waiting half per step: 36 and the current box fit.
    VoxelBox stack[40];
    int waiting = 0;
    stack[waiting++] = box;
    while (waiting > 0) {
        const VoxelBox here = stack[--waiting];
        const int axis = axis_too_long(here);
        if (axis < 0 || !holds_medium(here)) {
            PILEUS_TRY(append(here));
            continue;
        }
        VoxelBox low = here, high = here;
        low.hi[axis] = high.lo[axis] = (here.lo[axis] + here.hi[axis]) / 2;
        assert(waiting + 2 <= 40);
        stack[waiting++] = high;
        stack[waiting++] = low;
    }
    return Status::ok();
}

Status LeafList::add_with_samples(VoxelBox box, const SampleBounds& bounds) {
    const double radius = double(options_.influence_m);
    if (!(radius > 0)) return add(box);
    // At most one slab per side: a cut leaves less than a voxel beyond the radius.
    for (;;) {
        Cut best;
        for (int side = 0; side < 6; ++side)
            consider(box, bounds, grid_, radius, side / 2, side % 2 == 0, best);
        if (best.axis < 0) return add(box);
        VoxelBox slab = box;
        (best.low ? slab.hi : slab.lo)[best.axis] = best.face;
        (best.low ? box.lo : box.hi)[best.axis] = best.face;
        PILEUS_TRY(add(slab));
    }
}

Status LeafList::take(Buffer<Leaf>& leaves) {
    PILEUS_TRY(allocate(arrays::leaves(count_), leaves));
    std::copy(leaves_.data(), leaves_.data() + count_, leaves.data());
    leaves_ = Buffer<Leaf>();
    count_ = 0;
    return Status::ok();
}

}  // namespace pileus
