// SPDX-License-Identifier: Apache-2.0
// The sun's optical depth on nodes: how much medium lies between each voxel and the sun.
// in: a medium, a direction to the sun -> out: a grid of optical depths, read trilinearly.
// docs/buffer.md; Maerkl 2018; Elek et al. 2012
#pragma once
#include <array>

#include "src/picture/nodes/node_grid.h"
#include "src/picture/nodes/sun_slices.h"
#include "src/plan/array.h"
#include "src/run/context.h"
#include "src/world/majorant/majorants.h"

namespace pileus {

enum class SunDepthKind {
    kSwept,  ///< slice by slice away from the sun: O(voxels), thin shadows smear
    kExact,  ///< a ray for each node, empty space skipped
};

struct SunDepth {
    NodeGrid nodes{};             ///< one in the middle of each voxel
    Buffer<float> optical_depth;  ///< [node]
    bool swept = false;           ///< false: rays, asked for or needed (see make_sun_depth)
};

namespace arrays {

/// `last` marches.
inline Array<float> sun_depth(std::uint64_t nodes, Stage last) {
    return {"sunlight's optical depth on nodes", nodes, Stage::kShadow, last};
}

}  // namespace arrays

/// Fills `out`, whose memory is used again where it fits. `to_sun` is any direction but 0. A
/// periodic medium under a sun that is lower than one voxel in kMaxShift gets rays even where a
/// sweep was asked for. kLimit: out of memory. Needs kernels of the host.
Status make_sun_depth(const Context& context, const Medium& medium, const Majorants& majorants,
                      const std::array<float, 3>& to_sun, SunDepthKind kind, SunDepth& out);

/// The same by rays at `nodes`, while the sun moves: what `slices` do not hold for the frame's sun
/// is made, of nodes that are read for places in `read` (nodes_in_medium). kLimit: out of memory.
Status follow_sun_depth(const Context& context, const Medium& medium, const Majorants& majorants,
                        const MediumView& read, const NodeGrid& nodes, const SunTurn& turn,
                        SunSlices& slices, SunDepth& out);

/// Nodes that such a depth has: one in each voxel.
NodeGrid sun_depth_nodes(const Medium& medium);
/// Two voxels apart along axes that keep at least eight: for voxels within which light hardly
/// changes.
NodeGrid wide_sun_depth_nodes(const Medium& medium);

/// Compares with rays at about `wanted` nodes. kLimit: out of memory.
Status sun_depth_difference(const Context& context, const Medium& medium,
                            const Majorants& majorants, const std::array<float, 3>& to_sun,
                            const SunDepth& depth, std::uint64_t wanted, SweepCheck& out);

}  // namespace pileus
