// SPDX-License-Identifier: Apache-2.0
// How far the emptiness around each empty block of a grid reaches, so that walks may leap over it.
// in: majorants, zero where a block is empty -> out: minus the free blocks on all sides there.
// docs/path.md, "Flight"
#pragma once
#include <cstddef>
#include <cstdint>

#include "src/base/span.h"

namespace pileus {

/// Free blocks on each side that one leap may pass at most: it bounds the work per block.
constexpr int kLongestLeap = 31;

/// Blocks along a side at most: those of the largest grid, one voxel each, and a ring around them.
constexpr int kMostLine = 4096 + 2;

/// Writes -n into every block of count[0] x count[1] x count[2], x fastest, that is not positive:
/// all blocks within n of it along every axis are not positive either or lie beyond the grid, and n
/// is as large as that allows, at most kLongestLeap.
void mark_empty_blocks(Span<float> blocks, const int count[3], int threads);

}  // namespace pileus
