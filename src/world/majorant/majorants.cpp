// SPDX-License-Identifier: Apache-2.0
// See majorants.h.
#include "src/world/majorant/majorants.h"

#include "src/world/majorant/majorant.h"

namespace pileus {

Status make_skip_blocks(Span<const float> density, const Grid& grid, int block, int threads,
                        Buffer<float>& skipping) {
    PILEUS_TRY(majorant_grid(density, grid, block, threads, skipping));
    // Beyond a periodic grid lies the next period, not emptiness.
    if (grid.periodic) return Status::ok();
    int counts[3];
    block_counts(grid, block, counts);
    mark_empty_blocks(skipping.span(), counts, threads);
    return Status::ok();
}

Status make_majorants(const Medium& medium, bool local, const Context& context, Majorants& out,
                      const TrackingCosts& costs) {
    const StageClock clock(context, "majorants");
    const Span<const float> density = medium.volume.density.span();
    int largest = 1;
    for (int n : medium.grid.size) largest = n > largest ? n : largest;
    out.block = largest;
    if (local) {
        BlockChoice choice;
        PILEUS_TRY(choose_block(density, medium.grid, double(medium.sigma), costs, context.threads,
                                choice));
        out.block = choice.block;
    }
    PILEUS_TRY(majorant_grid(density, medium.grid, out.block, context.threads, out.tracking));
    return make_skip_blocks(density, medium.grid, out.skip_block, context.threads, out.skipping);
}

Status make_photon_majorants(const Medium& medium, bool local, const Context& context,
                             Majorants& out) {
    PILEUS_TRY(make_majorants(medium, local, context, out, kPhotonTracking));
    int counts[3];
    block_counts(medium.grid, out.block, counts);
    mark_empty_blocks(out.tracking.span(), counts, context.threads);
    return Status::ok();
}

TrackGrid track_grid(const Medium& medium, Span<const float> majorants, int block,
                     std::uint32_t max_events) {
    TrackGrid k{};
    for (int a = 0; a < 3; ++a) {
        k.size[a] = medium.grid.size[a];
        k.cell[a] = medium.grid.cell_m[a];
    }
    block_counts(medium.grid, block, k.blocks);
    k.block = float(block);
    k.sigma = medium.sigma;
    k.periodic = medium.grid.periodic ? 1 : 0;
    k.constant = medium.grid.constant ? 1 : 0;
    k.max_events = max_events;
    k.density = medium.volume.density.data();
    k.majorant = majorants.data;
    return k;
}

}  // namespace pileus
