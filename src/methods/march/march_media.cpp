// SPDX-License-Identifier: Apache-2.0
// Media of the look of method optical-depth: extinction cut, cells of their own towards the sun.
// in: the world's medium, a look -> out: MarchMedia.
// docs/optical-depth.md
#include "src/methods/march/march_state.h"
#include "src/world/medium/resample.h"
#include "src/world/world.h"

namespace pileus {
namespace {

/// Cells of the buffer, or one for each of the sun's wide nodes; axes that a look leaves alone have
/// the medium's.
std::array<int, 3> sun_cells(const FrameView& view, const MarchState& state) {
    const Medium& medium = view.world.medium;
    if (has_coarse_sun(view, state)) {
        const NodeGrid nodes = wide_sun_depth_nodes(medium);
        return {nodes.size[0], nodes.size[1], nodes.size[2]};
    }
    std::array<int, 3> cells = medium.volume.size;
    for (std::size_t a = 0; a < 3; ++a)
        if (state.choice.look->resolution[a] > 0) cells[a] = state.choice.look->resolution[a];
    return cells;
}

}  // namespace

bool caps_extinction(const FrameView& view, const MarchState& state) {
    const double most = state.choice.look ? state.choice.look->max_extinction_per_m : 0;
    if (!(most > 0) || state.media.outlined_only) return most > 0;
    const Medium& medium = view.world.medium;
    return most < max_extinction(medium);
}

bool has_coarse_sun(const FrameView& view, const MarchState& state) {
    return state.media.wide_sun && !state.choice.march_light &&
           !view.world.medium.detail.present() && view.scene.sun.present;
}

bool has_sun_grid(const FrameView& view, const MarchState& state) {
    if (has_coarse_sun(view, state)) return true;
    const auto& look = state.choice.look;
    // A sun that is below the horizon may rise.
    if (!look || !view.scene.sun.present) return false;
    return look->light_scale != 1 || sun_cells(view, state) != view.world.medium.volume.size;
}

Grid sun_grid(const FrameView& view, const MarchState& state) {
    const Medium& medium = view.world.medium;
    if (!has_sun_grid(view, state)) return medium.grid;
    return resampled_grid(medium, sun_cells(view, state));
}

const Medium& marched_medium(const FrameView& view, const MarchState& state) {
    const Medium& capped = state.media.capped;
    return capped.volume.density.empty() ? view.world.medium : capped;
}

bool has_wide_sun(const Medium& medium) {
    const Grid& grid = medium.grid;
    if (!has_thin_voxels(medium) || grid.constant) return false;
    if (node_count(wide_sun_depth_nodes(medium)) == voxel_count(grid)) return false;
    const float* density = medium.volume.density.data();
    const auto holds = [&](int x, int y, int z) { return density[voxel_index(grid, x, y, z)] > 0; };
    const int last[3] = {grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1};
    for (int y = 0; y <= last[1]; ++y)
        for (int x = 0; x <= last[0]; ++x)
            if (holds(x, y, 0) || holds(x, y, last[2])) return false;
    for (int z = 0; z <= last[2] && !grid.periodic; ++z) {
        for (int x = 0; x <= last[0]; ++x)
            if (holds(x, 0, z) || holds(x, last[1], z)) return false;
        for (int y = 0; y <= last[1]; ++y)
            if (holds(0, y, z) || holds(last[0], y, z)) return false;
    }
    return true;
}

Status cap_medium(const FrameView& view, MarchState& state) {
    const Medium& medium = view.world.medium;
    if (!caps_extinction(view, state)) return Status::ok();
    const float most = float(state.choice.look->max_extinction_per_m / double(medium.sigma));
    Medium& out = state.media.capped;
    out.low_m = medium.low_m;
    for (std::size_t a = 0; a < 3; ++a) out.extent_m[a] = medium.extent_m[a];
    out.grid = medium.grid;
    out.volume.size = medium.volume.size;
    out.sigma = medium.sigma;
    out.channels = medium.channels;
    out.optics = medium.optics;
    out.density_max = most;
    out.detail.view = medium.detail.view;
    out.detail.step_m = medium.detail.step_m;
    PILEUS_TRY(allocate(arrays::capped_density(medium.grid), out.volume.density));
    const Span<const float> from = medium.volume.density.span();
    const Span<float> to = out.volume.density.span();
    for (std::size_t i = 0; i < from.size; ++i) to[i] = from[i] < most ? from[i] : most;
    return Status::ok();
}

Status make_lit_medium(const Context& context, const FrameView& view, MarchState& state) {
    MarchMedia& media = state.media;
    if (!has_sun_grid(view, state) || !media.lit.volume.density.empty()) return Status::ok();
    const StageClock clock(context, "buffer cells");
    // Whole or not at all: what memory ended within is made anew.
    Medium lit;
    PILEUS_TRY(resample_medium(marched_medium(view, state), sun_cells(view, state), context.threads,
                               arrays::lit_density(sun_grid(view, state)), lit));
    if (!has_coarse_sun(view, state)) lit.sigma *= float(state.choice.look->light_scale);
    PILEUS_TRY(make_majorants(lit, false, context, media.lit_majorants));
    media.lit = std::move(lit);
    return Status::ok();
}

}  // namespace pileus
