// SPDX-License-Identifier: Apache-2.0
// See majorants.h.
// in: a density grid -> out: its levels.
// docs/raymarch.md, "Level of detail".
#include "platform/threads.h"
#include "src/world/majorant/majorants.h"

namespace pileus {
namespace {

/// Means of the finer cells under each cell of a slice.
void halve_slice(Span<const float> fine, const Grid& from, const Grid& to, int z,
                 Span<float> coarse) {
    const auto last = [](int at, int size) { return at + 1 < size ? at + 1 : at; };
    for (int y = 0; y < to.size[1]; ++y)
        for (int x = 0; x < to.size[0]; ++x) {
            const int xs[2] = {2 * x, last(2 * x, from.size[0])};
            const int ys[2] = {2 * y, last(2 * y, from.size[1])};
            const int zs[2] = {2 * z, last(2 * z, from.size[2])};
            // A cell without a neighbour counts twice: the mean of those that there are.
            float sum = 0;
            for (int i = 0; i < 8; ++i)
                sum += fine[voxel_index(from, xs[i & 1], ys[(i >> 1) & 1], zs[i >> 2])];
            coarse[voxel_index(to, x, y, z)] = sum * 0.125f;
        }
}

}  // namespace

std::vector<Grid> level_grids(const Grid& grid, int levels) {
    std::vector<Grid> out;
    Grid g = grid;
    while (int(out.size()) < levels) {
        const bool single = g.size[0] == 1 && g.size[1] == 1 && g.size[2] == 1;
        const bool odd = g.periodic && (g.size[0] % 2 != 0 || g.size[1] % 2 != 0);
        if (single || odd) break;
        for (int a = 0; a < 3; ++a) {
            g.size[a] = (g.size[a] + 1) / 2;
            g.cell_m[a] *= 2;
        }
        out.push_back(g);
    }
    return out;
}

Status make_density_levels(const Medium& medium, int levels, int block, const Context& context,
                           std::vector<DensityLevel>& out) {
    const StageClock clock(context, "levels");
    out.clear();
    Span<const float> fine = medium.volume.density.span();
    Grid from = medium.grid;
    const std::vector<Grid> grids = level_grids(medium.grid, levels);
    out.reserve(grids.size());
    for (const Grid& to : grids) {
        out.emplace_back();
        DensityLevel& level = out.back();
        level.grid = to;
        PILEUS_TRY(allocate(arrays::coarse_density(to, Stage::kWrite), level.density));
        parallel_for(context.threads, to.size[2], [&](std::int64_t z, int) {
            halve_slice(fine, from, to, int(z), level.density.span());
        });
        PILEUS_TRY(
            make_skip_blocks(level.density.span(), to, block, context.threads, level.majorants));
        fine = level.density.span();
        from = to;
    }
    return Status::ok();
}

}  // namespace pileus
