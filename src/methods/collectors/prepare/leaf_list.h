// SPDX-License-Identifier: Apache-2.0
// Finishes the boxes that the kD-tree ends with and collects them.
// in: a box and the bounds of its samples -> out: one or more leaves that tile the box.
// Elek 2011, figure 5.4: cut away what no sample covers; docs/methods.md 3, prepare 3.
#pragma once
#include "src/methods/collectors/prepare/tree.h"

namespace pileus {

/// Voxel faces, half-open.
struct VoxelBox {
    std::int32_t lo[3], hi[3];
};

/// Bounds of a node's samples in voxel coordinates.
struct SampleBounds {
    float lo[3], hi[3];
};

namespace arrays {

/// The list while it grows: `room` leaves. Together with the smaller one that it takes over, and
/// then with the finished leaves, it is within room for twice the leaves and 1024 more.
inline Array<Leaf> growing_leaves(std::uint64_t room) {
    return {"growing list of leaves", room, Stage::kTree, Stage::kTree};
}

}  // namespace arrays

class LeafList {
public:
    LeafList(Span<const float> density, const Grid& grid, const TreeOptions& options)
        : density_(density), grid_(grid), options_(options) {}

    /// Adds a box that holds samples: first cuts off slabs farther from them than the radius of
    /// influence, the widest gap first.
    Status add_with_samples(VoxelBox box, const SampleBounds& bounds);

    /// Adds a box, halved while it holds medium and is longer than allowed.
    Status add(const VoxelBox& box);

    /// Hands over the leaves, exactly as many as were added.
    Status take(Buffer<Leaf>& leaves);

private:
    bool holds_medium(const VoxelBox& box) const;
    bool at_face(const VoxelBox& box) const;
    int axis_too_long(const VoxelBox& box) const;
    Status append(const VoxelBox& box);

    Span<const float> density_;
    Grid grid_;
    TreeOptions options_;
    Buffer<Leaf> leaves_;
    std::size_t count_ = 0;
};

}  // namespace pileus
