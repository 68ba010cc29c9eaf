// SPDX-License-Identifier: Apache-2.0
// The path tracer's grid of bounds: majorants, and in empty blocks how far the emptiness reaches.
// in: majorants per block -> out: the same, zeros replaced by minus a number of blocks.
// docs/path.md, "Flight"
#pragma once
#include "src/plan/array.h"
#include "src/world/grid/grid.h"

namespace pileus {

namespace arrays {

/// Blocks of `block` voxels and a ring of one block around them.
Array<float> path_blocks(const Grid& grid, int block);

}  // namespace arrays

/// Copies `majorants`, counts[0] x counts[1] x counts[2] blocks, x fastest, into a grid with a ring
/// of one block around them. Empty blocks are marked (mark_empty_blocks); the ring gets kBoundOut.
/// kLimit: out of memory.
Status path_blocks(Span<const float> majorants, const std::int32_t counts[3], int threads,
                   Buffer<float>& out);

}  // namespace pileus
