// SPDX-License-Identifier: Apache-2.0
// Every array of the method, by the declarations of the stages that allocate them.
// in: see collectors_memory.h -> out: rows.
// docs/report.md, "Memory".
#include "src/methods/collectors/collectors_memory.h"

#include "kernels_cpu/display/blend_params.h"
#include "src/methods/collectors/billboards/billboard_spheres.h"
#include "src/methods/collectors/collectors_display.h"
#include "src/methods/collectors/photons/guided_grid.h"
#include "src/methods/collectors/prepare/place_collectors.h"
#include "src/methods/collectors/prepare/shares.h"
#include "src/methods/collectors/prepare/tree.h"
#include "src/photons/lit_march.h"
#include "src/photons/photon_report.h"

namespace pileus {
namespace {

using Size = std::uint64_t;
constexpr Size kFloat = sizeof(float);

Stage last_tracing(const CollectorsSizes& s) {
    return s.shoots_again ? Stage::kWrite : Stage::kPhotons;
}

void add_samples(const CollectorsSizes& s, MemoryTable& t) {
    if (s.cells) return;
    add(t, arrays::gradient_field(s.grid));
    if (s.variance)
        add(t, arrays::variance_sums(s.grid), arrays::variance_slices(s.grid, s.threads),
            arrays::variance_rows(s.grid, s.threads));
    add(t, arrays::row_sums(s.grid), arrays::empty_row(s.grid), arrays::slice_stats(s.grid));
    if (s.rejection) add(t, arrays::drawn_samples(s.samples), arrays::sample_tries(s.samples));
    add(t, arrays::samples(s.samples));
}

void add_tree(const CollectorsSizes& s, MemoryTable& t) {
    add(t, arrays::leaves(s.leaves));
    if (!s.cells) add_tree_rows(s.grid, s.samples, s.leaves, t);
}

void add_collectors(const CollectorsSizes& s, MemoryTable& t) {
    const Stage traced = last_tracing(s);
    add(t, arrays::leaf_moments(s.leaves), arrays::row_masses(s.grid, s.threads));
    add(t, arrays::collector_of_voxel(s.grid, traced));
    add(t, arrays::collectors(s.collectors));
    if (s.media > 1) {
        add(t, arrays::part_masses(s.grid));
        add(t, arrays::shares(s.collectors, s.media));
    }
    if (s.paper) add(t, arrays::sample_centroids(s.leaves));
    add_majorant_rows(s.grid, s.tracking_blocks, s.threads, traced, t);
}

void add_photons(const CollectorsSizes& s, MemoryTable& t) {
    const Stage traced = last_tracing(s);
    add_slot_rows(collectors_slot(s), s.lights, s.slots, s.sums_ring, t);
    add(t, arrays::photon_tallies(s.threads, traced));
    const auto own = arrays::photon_sums(0, 0, traced);
    t.add(own.name, own.first, own.last, s.private_sums);
}

/// Light around a camera that is near enough.
void add_near(const CollectorsSizes& s, MemoryTable& t) {
    if (s.near_nodes == 0) return;
    const Size parts = s.planes / 3;
    add(t, arrays::near_collectors(s.collectors));
    add(t, renamed(arrays::collector_colours(s.near_harmonics, s.collectors),
                   "harmonics of near collectors", Stage::kSplat, Stage::kSplat));
    add(t, renamed(arrays::splat_colours(s.near_harmonics + 1, s.collectors),
                   "near harmonics side by side", Stage::kSplat, Stage::kSplat));
    add(t, renamed(arrays::source_grid(s.near_harmonics + 1, s.near_levels, Stage::kSplat),
                   "near source grid", Stage::kSplat, Stage::kSplat));
    add(t, arrays::near_nodes(parts * s.near_stored, s.near_nodes));
}

/// Up to the display.
void add_light(const CollectorsSizes& s, MemoryTable& t) {
    const Size pixels = s.width * s.height;
    const Size source = s.harmonics > 0 ? s.harmonics : s.planes;
    add(t, arrays::collector_colours(source, s.collectors));
    add(t,
        arrays::picture_planes(plane_count(s.planes, s.ground, s.depth) + s.extra_planes, pixels));
    if (s.extra_planes > 0)
        add(t,
            renamed(arrays::picture_planes(plane_count(s.parts ? 3 : 0, s.ground, false), pixels),
                    "planes of a part", Stage::kDisplay, Stage::kDisplay));
    if (s.parts)
        add(t, renamed(arrays::collector_colours(3, s.collectors), "colours of a part",
                       Stage::kDisplay, Stage::kDisplay));
    add(t, arrays::ground_light(s.ground_cells));
    if (s.planes > 3 && s.ground_cells > 0)
        add(t, arrays::batch_background(pixels), arrays::ground_light(s.ground_cells));
    const Stage shadows = s.shoots_again ? Stage::kPhotons : Stage::kShadow;
    add(t, arrays::shadow(s.shadow_nodes, shadows), arrays::beam_tables(s.beam_sets, shadows));
    add(t, arrays::lamp_depths(s.lamp_depths));
    if (s.marched) {
        add(t, arrays::splat_colours(source + 1, s.collectors));
        add(t, arrays::source_grid(source + 1, s.source_nodes, Stage::kWrite));
        if (s.guided_nodes > 0)
            add(t, arrays::node_guides(s.guided_nodes),
                arrays::guided_sums(source + 1, s.source_nodes - s.guided_nodes));
        add(t, arrays::source_by_node(s.numbers_by_node));
        add_near(s, t);
        add(t, arrays::source_planes(s.planes_by_channel, s.fine_nodes));
    }
}

/// No tile is smaller than 256 by one row, or than the picture.
void add_billboards(const CollectorsSizes& s, MemoryTable& t) {
    if (s.marched) return;
    const Size wide = s.width < 256 ? s.width : 256;
    Size high = (Size{1} << 17) / ((Size(kBlendPlanes) + s.planes) * wide);
    high = high < 1 ? 1 : (high > 32 ? 32 : high);
    if (high > s.height) high = s.height;
    const Size tiles = ((s.width + wide - 1) / wide) * ((s.height + high - 1) / high);
    add(t, arrays::billboard_numbers(s.collectors), arrays::billboard_spheres(s.collectors),
        arrays::billboard_order(s.collectors),
        several(2, arrays::billboard_distances(s.collectors)));
    add(t, arrays::billboards_of_tiles(bytes_of(s.collectors, tiles)),
        several(2, arrays::tile_begin(tiles)));
    const Size row = (wide + 15) / 16 * 16;
    t.add(
        "planes of tiles", Stage::kDisplay, Stage::kDisplay,
        bytes_of(kFloat * s.threads,
                 row * (high * (Size(kBlendPlanes) + s.planes) + 1 + 2 * kBlendBlock) + high + 16));
}

}  // namespace

MemoryTable collectors_memory(const CollectorsSizes& sizes) {
    MemoryTable table;
    add_density_rows(sizes.grid, sizes.source, sizes.media, sizes.phases, sizes.threads, sizes.sky,
                     table);
    add_samples(sizes, table);
    add_tree(sizes, table);
    add_collectors(sizes, table);
    add_photons(sizes, table);
    add_light(sizes, table);
    add_billboards(sizes, table);
    add_image_rows(sizes.width, sizes.height, sizes.layers, table);
    return table;
}

std::uint64_t collectors_peak(const CollectorsSizes& sizes) {
    return collectors_memory(sizes).peak();
}

Status measure_memory(const Context& context, const FrameView& view, const CollectorsState& state,
                      const CollectorsSizes& measured, Plan& plan) {
    CollectorsSizes sizes = measured;
    sizes.private_sums =
        scratch_bytes(plan.accumulation.bytes, bytes_of_sums(sizes), sizes.sums_ring);
    plan.memory = collectors_memory(sizes);
    add_picture_rows(context, view, state, plan.memory);
    add_solid_rows(view.scene, context.limits, view.world.solids, view.environment.depth,
                   plan.memory);
    PILEUS_TRY(check_limit(context.limits, LimitId::kMemory, plan.memory.peak(), view.scene.file));
    plan.work = estimate_work(medium_work(view.world.medium, view.world.source.mean_density,
                                          double(state.lights.max_events),
                                          double(photons_of_run(state, context))));
    return check_work(plan.work, context.limits, view.scene.file);
}

}  // namespace pileus
