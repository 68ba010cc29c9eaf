// SPDX-License-Identifier: Apache-2.0
// The majorants of a medium: those that free flights track by, and those that marches skip by.
// in: a medium -> out: two coarse grids of largest densities, read only once they are made.
// docs/methods.md 1; majorant.h describes one grid of them.
#pragma once
#include "kernels_cpu/media/track_grid.h"
#include "src/run/context.h"
#include "src/world/majorant/majorant.h"
#include "src/world/medium/medium.h"

namespace pileus {

struct Majorants {
    Buffer<float> tracking;       ///< per tracking block
    int block = 1;                ///< edge of a tracking block, voxels
    Buffer<float> skipping;       ///< per block of the marching kernels
    int skip_block = kSkipBlock;  ///< its edge, voxels
};

/// Blocks that marches skip by: the largest density of each, and where that is 0, minus the empty
/// blocks on all sides (mark_empty_blocks), unless the grid is periodic. kLimit: out of memory.
Status make_skip_blocks(Span<const float> density, const Grid& grid, int block, int threads,
                        Buffer<float>& skipping);

/// The tracking blocks and the skipping blocks; `costs` of tracking choose the former. Not `local`:
/// one tracking block for the whole grid. kLimit: out of memory.
Status make_majorants(const Medium& medium, bool local, const Context& context, Majorants& out,
                      const TrackingCosts& costs = {});

/// What suits photons: fitted to the times of blocks of 4, 8 and 16 voxels on two clouds
/// (docs/performance.md).
constexpr TrackingCosts kPhotonTracking{1.0, 0.85, 0.15};

/// The same for photons, which leap over empty blocks: with blocks that suit them, and with the
/// empty ones marked (mark_empty_blocks).
Status make_photon_majorants(const Medium& medium, bool local, const Context& context,
                             Majorants& out);

/// What trackers need of a medium. `block` as the majorants were made with.
TrackGrid track_grid(const Medium& medium, Span<const float> majorants, int block,
                     std::uint32_t max_events);

}  // namespace pileus
