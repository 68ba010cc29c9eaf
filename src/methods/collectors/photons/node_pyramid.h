// SPDX-License-Identifier: Apache-2.0
// Levels of a grid of nodes, each of half the nodes along each axis, down to a single node.
// in: a grid of nodes -> out: sizes and places of all levels in one array, the finest first.
// docs/methods.md 3, repair 4.
#pragma once
#include <vector>

#include "kernels_cpu/display/lit_nodes.h"
#include "kernels_cpu/display/march_params.h"

namespace pileus {

/// One level of the pyramid: sums over 2^level nodes along each axis.
struct NodeLevel {
    std::int32_t size[3];
    std::size_t first;  ///< its first node among those of all levels
    std::size_t nodes() const {
        return std::size_t(size[0]) * std::size_t(size[1]) * std::size_t(size[2]);
    }
    std::size_t row(int y, int z) const {
        return std::size_t(z) * std::size_t(size[1]) + std::size_t(y);
    }
    std::size_t node(int x, std::size_t row) const {
        return row * std::size_t(size[0]) + std::size_t(x);
    }
};

std::vector<NodeLevel> node_levels(const NodeGrid& nodes);

/// Threads for a level: waking them takes as long as thousands of nodes.
inline int threads_of(const NodeLevel& level, int threads) {
    return level.nodes() < 8192 ? 1 : threads;
}

/// to += factor * from, numbers side by side; four are a colour and its weight.
inline void add_scaled(float factor, const float* from, std::size_t count, float* to) {
    if (count == 4) {
        const F<4> sum = load_quad(to) + all<F<4>>(factor) * load_quad(from);
        __builtin_memcpy(to, &sum, sizeof sum);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) to[i] += factor * from[i];
}

/// Adds the eight nodes below each node of `up` in slice z, `own` numbers a node; of each row of
/// `fine` those within `touched`, or all where that is null.
void sum_children(const NodeLevel& fine, const float* from, const NodeRange* touched,
                  const NodeLevel& up, int z, std::size_t own, float* to);

}  // namespace pileus
