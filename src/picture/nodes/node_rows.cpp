// SPDX-License-Identifier: Apache-2.0
// See node_rows.h.
#include "src/picture/nodes/node_rows.h"

#include "kernels_cpu/core/lanes.h"

namespace pileus {
namespace {

/// A place at a block's face may be read as lying in either block: a tenth of a voxel holds that.
constexpr float kAround = 0.1f;

/// Nodes along an axis that are read for places in so many blocks.
NodeRange nodes_of_blocks(const NodeGrid& g, const MediumView& m, int axis, int first, int last) {
    const float per_voxel = m.cell[axis] * g.per_metre[axis];
    const float low = (float(first) * m.block - kAround) * per_voxel - 0.5f;
    const float high = (float(last) * m.block + kAround) * per_voxel - 0.5f;
    // Beyond the outermost nodes a line through two of them is read.
    const int size = g.size[axis], lowest = size > 1 ? size - 2 : 0;
    const int from = floor_int(low) < lowest ? floor_int(low) : lowest;
    const int to = floor_int(high) < 0 ? 2 : floor_int(high) + 2;
    return {from < 0 ? 0 : from, to < size ? to : size};
}

}  // namespace

std::vector<NodeRange> nodes_in_medium(const NodeGrid& g, const MediumView& m) {
    const std::size_t rows = std::size_t(g.size[1]) * std::size_t(g.size[2]);
    if (m.density == nullptr || m.periodic != 0)
        return std::vector<NodeRange>(rows, NodeRange{0, g.size[0]});
    std::vector<NodeRange> out(rows, NodeRange{g.size[0], 0});
    const float* row = m.majorant;
    for (int z = 0; z < m.blocks[2]; ++z)
        for (int y = 0; y < m.blocks[1]; ++y, row += m.blocks[0]) {
            int first = 0, last = m.blocks[0];
            while (first < last && !(row[first] > 0)) ++first;
            while (last > first && !(row[last - 1] > 0)) --last;
            if (first == last) continue;
            const NodeRange xs = nodes_of_blocks(g, m, 0, first, last);
            const NodeRange ys = nodes_of_blocks(g, m, 1, y, y + 1);
            const NodeRange zs = nodes_of_blocks(g, m, 2, z, z + 1);
            for (int k = zs.first; k < zs.last; ++k)
                for (int j = ys.first; j < ys.last; ++j) {
                    NodeRange& own = out[std::size_t(k) * std::size_t(g.size[1]) + std::size_t(j)];
                    own.first = xs.first < own.first ? xs.first : own.first;
                    own.last = xs.last > own.last ? xs.last : own.last;
                }
        }
    return out;
}

}  // namespace pileus
