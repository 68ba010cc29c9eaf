// SPDX-License-Identifier: Apache-2.0
// The path tracer's grid of bounds: majorants, and in empty blocks how far the emptiness reaches.
// in: majorants per block -> out: the same, zeros replaced by minus a number of blocks.
// docs/path.md, "Flight"
#pragma once
#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/stages/prepared.h"

namespace pileus {

/// Copies `majorants`, counts[0] x counts[1] x counts[2] blocks, x fastest, into a grid with a ring
/// of one block around them. An empty block (0) gets -n, where all blocks within n of it along
/// every axis are empty or lie beyond the grid, and n is as large as that allows, at most 31; the
/// ring gets kBoundOut. kLimit: out of memory.
Status path_blocks(Span<const float> majorants, const std::int32_t counts[3], int threads,
                   Buffer<float>& out);

/// Bytes that path_blocks takes for blocks of `block` voxels.
std::uint64_t path_blocks_bytes(const Grid& grid, int block, int threads);

}  // namespace pileus
