// SPDX-License-Identifier: Apache-2.0
// A coarse grid of largest densities, so that free flights take long steps through thin air.
// in: densities -> out: the largest density per block of voxels, and the best size of a block.
// docs/methods.md 1 (majorant over the trilinear footprint); tools/bench/README.md.
#pragma once
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "src/base/buffer.h"
#include "src/base/span.h"
#include "src/base/status.h"
#include "src/plan/array.h"
#include "src/world/grid/grid.h"

namespace pileus {

/// Blocks of `block` voxels along each axis that cover the grid; the last may be cut short.
template <class Int>  // int, or the std::int32_t of kernels, which is long on some machines
void block_counts(const Grid& grid, int block, Int counts[3]) {
    assert(block >= 1);
    for (int a = 0; a < 3; ++a) counts[a] = (grid.size[a] - 1) / block + 1;
}

/// All of them.
std::uint64_t block_total(const Grid& grid, int block);

/// Edge of the blocks that marches skip by, voxels.
constexpr int kSkipBlock = 4;

namespace arrays {

/// A number for each block.
inline Array<float> block_maxima(const Grid& grid, int block) {
    return {"majorants", block_total(grid, block), Stage::kMajorants, Stage::kWrite};
}
/// Those that flights track by; `last` traces. Their number is bounded before they are made.
inline Array<float> majorants(std::uint64_t blocks, Stage last) {
    return {"majorants", blocks, Stage::kMajorants, last};
}
inline Array<float> blocks_to_skip(const Grid& grid) {
    return renamed(block_maxima(grid, kSkipBlock), "blocks to skip", Stage::kMajorants,
                   Stage::kWrite);
}
/// The largest of a slice's columns, and of its rows, per thread.
inline Array<float> majorant_rows(const Grid& grid, std::uint64_t threads) {
    const std::uint64_t nx = std::uint64_t(grid.size[0]), ny = std::uint64_t(grid.size[1]);
    return {"rows of the majorants", bytes_of(nx * ny + nx, threads), Stage::kMajorants,
            Stage::kMajorants};
}

}  // namespace arrays

/// Largest density of each block and its one-voxel border, which in a periodic grid goes on at the
/// far face in x and y; x fastest, into `majorants`
/// (block_counts of them). kLimit: out of memory.
Status majorant_grid(Span<const float> density, const Grid& grid, int block, int threads,
                     Buffer<float>& majorants);

/// What one event of tracking costs, in any one unit.
struct TrackingCosts {
    double tentative = 1.0;  ///< a tentative collision
    double crossing = 0.5;   ///< a step across a block's border
    double empty = 0.5;      ///< the same where the block holds no medium
};

struct BlockChoice {
    int block = 0;        ///< the cheapest edge, voxels
    int candidates = 0;   ///< entries below, rising edges; the last covers the whole grid
    int edge[7] = {};     ///< voxels
    double cost[7] = {};  ///< predicted, m^2 times the unit of TrackingCosts
};

/// Grids with more voxels than this get no blocks of a single voxel.
constexpr std::uint64_t kMaxSingleVoxels = std::uint64_t{1} << 24;

/// Predicts the cost of tracking in uniform diffuse light for blocks of 1, 2, 4 ... 32 voxels and
/// the whole grid: a block of volume V, surface S and majorant M sees sigma M V tentative
/// collisions per S/4 crossings. `extinction_per_m` is sigma, at density 1. The smallest cost
/// wins, on ties the larger block. kLimit: out of memory.
Status choose_block(Span<const float> density, const Grid& grid, double extinction_per_m,
                    const TrackingCosts& costs, int threads, BlockChoice& choice);

// How far the emptiness around each empty block reaches, so that walks may leap over it.
// docs/path.md, "Flight"

/// Free blocks on each side that one leap may pass at most: it bounds the work per block.
constexpr int kLongestLeap = 31;

/// Blocks along a side at most: those of the largest grid, one voxel each, and a ring around them.
constexpr int kMaxLine = 4096 + 2;

/// Writes -n into every block of count[0] x count[1] x count[2], x fastest, that is not positive:
/// all blocks within n of it along every axis are not positive either or lie beyond the grid, and n
/// is as large as that allows, at most kLongestLeap.
void mark_empty_blocks(Span<float> blocks, const int count[3], int threads);

}  // namespace pileus
