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
    if (s.prepared.cells) return;
    add(t, arrays::gradient_field(s.grid));
    if (s.prepared.variance)
        add(t, arrays::variance_sums(s.grid), arrays::variance_slices(s.grid, s.threads),
            arrays::variance_rows(s.grid, s.threads));
    add(t, arrays::row_sums(s.grid), arrays::empty_row(s.grid), arrays::slice_stats(s.grid));
    if (s.prepared.rejection)
        add(t, arrays::drawn_samples(s.prepared.samples), arrays::sample_tries(s.prepared.samples));
    add(t, arrays::samples(s.prepared.samples));
}

void add_tree(const CollectorsSizes& s, MemoryTable& t) {
    add(t, arrays::leaves(s.prepared.leaves));
    if (!s.prepared.cells) add_tree_rows(s.grid, s.prepared.samples, s.prepared.leaves, t);
}

void add_collectors(const CollectorsSizes& s, MemoryTable& t) {
    const Stage traced = last_tracing(s);
    add(t, arrays::leaf_moments(s.prepared.leaves), arrays::row_masses(s.grid, s.threads));
    add(t, arrays::collector_of_voxel(s.grid, traced));
    add(t, arrays::collectors(s.prepared.collectors));
    if (s.media > 1) {
        add(t, arrays::part_masses(s.grid));
        add(t, arrays::shares(s.prepared.collectors, s.media));
    }
    if (s.prepared.paper) add(t, arrays::sample_centroids(s.prepared.leaves));
    add_majorant_rows(s.grid, s.prepared.tracking_blocks, s.threads, traced, t);
}

void add_photons(const CollectorsSizes& s, MemoryTable& t) {
    const Stage traced = last_tracing(s);
    add_slot_rows(collectors_slot(s), s.photons.lights, s.photons.slots, s.photons.sums_ring, t);
    add(t, arrays::photon_tallies(s.threads, traced));
    const auto own = arrays::photon_sums(0, 0, traced);
    t.add(own.name, own.first, own.last, s.photons.private_sums);
}

/// Light around a camera that is near enough.
void add_near(const CollectorsSizes& s, MemoryTable& t) {
    if (s.nodes.near_nodes == 0) return;
    const Size parts = s.picture.planes / 3;
    add(t, arrays::near_collectors(s.prepared.collectors));
    add(t, renamed(arrays::collector_colours(s.nodes.near_harmonics, s.prepared.collectors),
                   "harmonics of near collectors", Stage::kSplat, Stage::kSplat));
    add(t, renamed(arrays::splat_colours(s.nodes.near_harmonics + 1, s.prepared.collectors),
                   "near harmonics side by side", Stage::kSplat, Stage::kSplat));
    add(t,
        renamed(arrays::source_grid(s.nodes.near_harmonics + 1, s.nodes.near_levels, Stage::kSplat),
                "near source grid", Stage::kSplat, Stage::kSplat));
    add(t, arrays::near_nodes(parts * s.nodes.near_stored, s.nodes.near_nodes));
}

/// Up to the display.
void add_light(const CollectorsSizes& s, MemoryTable& t) {
    const Size pixels = s.picture.width * s.picture.height;
    const Size source = s.nodes.harmonics > 0 ? s.nodes.harmonics : s.picture.planes;
    add(t, arrays::collector_colours(source, s.prepared.collectors));
    add(t, arrays::picture_planes(plane_count(s.picture.planes, s.picture.ground, s.picture.depth) +
                                      s.picture.extra_planes,
                                  pixels));
    if (s.picture.extra_planes > 0)
        add(t, renamed(arrays::picture_planes(
                           plane_count(s.picture.parts ? 3 : 0, s.picture.ground, false), pixels),
                       "planes of a part", Stage::kDisplay, Stage::kDisplay));
    if (s.picture.parts)
        add(t, renamed(arrays::collector_colours(3, s.prepared.collectors), "colours of a part",
                       Stage::kDisplay, Stage::kDisplay));
    add(t, arrays::ground_light(s.photons.ground_cells));
    if (s.picture.planes > 3 && s.photons.ground_cells > 0)
        add(t, arrays::batch_background(pixels), arrays::ground_light(s.photons.ground_cells));
    const Stage shadows = s.shoots_again ? Stage::kPhotons : Stage::kShadow;
    add(t, arrays::shadow(s.nodes.shadow_nodes, shadows),
        arrays::beam_tables(s.nodes.beam_sets, shadows));
    add(t, arrays::lamp_depths(s.nodes.lamp_depths));
    if (s.picture.marched) {
        add(t, arrays::splat_colours(source + 1, s.prepared.collectors));
        add(t, arrays::source_grid(source + 1, s.nodes.source_nodes, Stage::kWrite));
        if (s.nodes.guided_nodes > 0)
            add(t, arrays::node_guides(s.nodes.guided_nodes),
                arrays::guided_sums(source + 1, s.nodes.source_nodes - s.nodes.guided_nodes));
        add(t, arrays::source_by_node(s.nodes.numbers_by_node));
        add_near(s, t);
        add(t, arrays::source_planes(s.nodes.planes_by_channel, s.nodes.fine_nodes));
    }
}

/// No tile is smaller than 256 by one row, or than the picture.
void add_billboards(const CollectorsSizes& s, MemoryTable& t) {
    if (s.picture.marched) return;
    const Size wide = s.picture.width < 256 ? s.picture.width : 256;
    Size high = (Size{1} << 17) / ((Size(kBlendPlanes) + s.picture.planes) * wide);
    high = high < 1 ? 1 : (high > 32 ? 32 : high);
    if (high > s.picture.height) high = s.picture.height;
    const Size tiles =
        ((s.picture.width + wide - 1) / wide) * ((s.picture.height + high - 1) / high);
    add(t, arrays::billboard_numbers(s.prepared.collectors),
        arrays::billboard_spheres(s.prepared.collectors),
        arrays::billboard_order(s.prepared.collectors),
        several(2, arrays::billboard_distances(s.prepared.collectors)));
    add(t, arrays::billboards_of_tiles(bytes_of(s.prepared.collectors, tiles)),
        several(2, arrays::tile_begin(tiles)));
    const Size row = (wide + 15) / 16 * 16;
    t.add("planes of tiles", Stage::kDisplay, Stage::kDisplay,
          bytes_of(kFloat * s.threads,
                   row * (high * (Size(kBlendPlanes) + s.picture.planes) + 1 + 2 * kBlendBlock) +
                       high + 16));
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
    add_image_rows(sizes.picture.width, sizes.picture.height, sizes.picture.layers, table);
    return table;
}

std::uint64_t collectors_peak(const CollectorsSizes& sizes) {
    return collectors_memory(sizes).peak();
}

Status measure_memory(const Context& context, const FrameView& view, const CollectorsState& state,
                      const CollectorsSizes& measured, Plan& plan) {
    CollectorsSizes sizes = measured;
    sizes.photons.private_sums =
        scratch_bytes(plan.accumulation.bytes, bytes_of_sums(sizes), sizes.photons.sums_ring);
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
