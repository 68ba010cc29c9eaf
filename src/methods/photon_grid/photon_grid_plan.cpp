// SPDX-License-Identifier: Apache-2.0
// Weighs a run of the photon grid: memory, work, bounds of its sums, limits.
// in: PhotonGridRun, outlined or prepared -> out: its plan; kLimit where something is too much.
// docs/report.md, "Plan"; docs/photon-grid.md, "Memory".
#include "kernels_cpu/core/profile.h"
#include "src/methods/photon_grid/photon_grid.h"
#include "src/photons/lit_march.h"
#include "src/photons/photon_report.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

using Size = std::uint64_t;

constexpr Stage kUnused[] = {Stage::kPaths, Stage::kSamples, Stage::kTree, Stage::kCollectors,
                             Stage::kLeafGrid};

SlotSize slot_of(const PhotonGridRun& run) {
    return {run.cells.count(), Size(run.deposit.channels), Size(run.deposit.coefficients),
            Size(run.ground_map.cells) * Size(run.ground_map.cells)};
}

Size bytes_of_thread(const PhotonGridRun& run) {
    return sum_of_bytes(arrays::photon_slot(slot_of(run), 1).bytes(), 256);
}

/// Harmonics of a cell as the march reads them.
Size harmonic_numbers(const PhotonGridRun& run) {
    return Size(harmonic_sets(run.deposit.channels, run.lighting)) *
           Size(stored_harmonics(run.deposit));
}

/// Numbers per cell while it is shown.
Size light_numbers(const PhotonGridRun& run) {
    return shows_harmonics(run) ? harmonic_numbers(run) : 3 * (1 + Size(photon_batches(run)));
}

void add_photons(const PhotonGridRun& run, const Context& context, Size private_sums,
                 MemoryTable& t) {
    const Medium& m = run.world->medium;
    const Size threads = Size(context.threads);
    // A wanted error looks at pictures between photons.
    const bool looks = context.frames > 1 || run.budget.error > 0;
    const Stage traced = looks ? Stage::kWrite : Stage::kPhotons;
    const Size blocks = run.outlined_only
                            ? most_tracking_blocks(m.grid, run.settings.local_tracking)
                            : run.majorants.tracking.size();
    add_majorant_rows(m.grid, blocks, threads, traced, t);
    add(t, arrays::cell_marks(run.cells.count()));
    if (m.count > 1) add(t, arrays::cell_shares(run.cells.count(), Size(m.count)));
    add_slot_rows(slot_of(run), run.lighting.lights.size(), photon_slots(run), sums_ring(run), t);
    add(t, arrays::photon_tallies(threads, traced));
    const auto own = arrays::photon_sums(0, 0, traced);
    t.add(own.name, own.first, own.last, private_sums);
}

void add_picture(const PhotonGridRun& run, const Context& context, MemoryTable& t) {
    const OutputSettings& output = run.scene->output;
    const auto& size = run.scene->camera.resolution;
    const Size pixels = Size(size[0]) * Size(size[1]);
    const Size planes = 3 * (1 + Size(photon_batches(run)));
    const Size parts = (output.layer_light ? 3u : 0u) + (output.layer_order ? 3u : 0u);
    const Size extra = parts + (output.layer_optical_depth ? 1u : 0u);
    const Size ground = slot_of(run).ground_cells;
    const bool solid = run.lighting.opaque();
    add(t, arrays::cell_light(light_numbers(run), run.cells.count()));
    if (shows_near(run))
        add(t, arrays::near_nodes(planes / 3 * harmonic_numbers(run),
                                  near_nodes_of(run, cell_nodes(run), context)));
    const bool reads_quads = (planes == 3 || parts > 0) && !shows_harmonics(run) &&
                             run.cells.count() > 1 &&
                             (!kDevices || context.kernels->device == nullptr);
    add(t, arrays::lit_quads(reads_quads ? run.cells.count() : 0));
    add(t, arrays::picture_planes(plane_count(planes, solid, run.scene->wants_depth()) + extra,
                                  pixels));
    if (extra > 0)
        add(t, renamed(arrays::picture_planes(plane_count(parts > 0 ? 3 : 0, solid, false), pixels),
                       "planes of a part", Stage::kDisplay, Stage::kDisplay));
    if (parts > 0)
        add(t, renamed(arrays::cell_light(3, run.cells.count()), "light of a part", Stage::kDisplay,
                       Stage::kDisplay));
    add(t, arrays::ground_light(ground));
    if (planes > 3 && ground > 0)
        add(t, arrays::batch_background(pixels), arrays::ground_light(ground));
    const Stage shadows = context.frames > 1 ? Stage::kPhotons : Stage::kShadow;
    if (run.lighting.sunlit && run.deposit.first_order == 2)
        add(t, arrays::shadow(sun_shadow_numbers(run), shadows));
    add(t, arrays::beam_tables(beam_sets(run), shadows));
    add(t, arrays::lamp_depths(lamp_numbers(run.world->medium, run.lighting)));
    add_image_rows(Size(size[0]), Size(size[1]), 4 + extra_layers(output, planes > 3), t);
}

MemoryTable memory_of(const PhotonGridRun& run, const Context& context, Size private_sums) {
    MemoryTable t;
    if (!kPlans) return t;
    add_density_rows(run.world->medium.grid, run.world->source, Size(run.world->medium.count),
                     phase_bytes(run.world->medium), Size(context.threads),
                     sky_map_bytes(run.environment.sky_map), t);
    add_photons(run, context, private_sums, t);
    add_picture(run, context, t);
    return t;
}

/// All that the scene asks for; where time decides, what the sums hold at most is no work to come.
Size all_photons(const PhotonGridRun& run, const Context& context) {
    if (run.ring) return photons_of_run(run, context);
    Size generation = 0;
    for (const Light& light : run.lighting.lights) generation += light.photons;
    return bytes_of(generation, planned_generations(run), context.frames);
}

}  // namespace

Status photon_grid_measure(const Context& context, PhotonGridRun& run) {
    const Size photons = all_photons(run, context);
    PILEUS_TRY(check_limit(context.limits, LimitId::kPhotons, photons, run.scene->file));
    const double most = double(photons) > run.most_photons ? double(photons) : run.most_photons;
    bound_ledgers(most, double(run.max_events), run.plan);
    PILEUS_TRY(check_bounds(run.plan, run.scene->file, "photon_grid.photons"));
    run.plan.exact = !run.outlined_only;
    run.plan.accumulation = plan_accumulation(
        run.settings.accumulation,
        {Size(context.threads), bytes_of_thread(run), memory_of(run, context, 0).peak(),
         context.limits[LimitId::kMemory], run.plan.exact});
    if (!kPlans) return Status::ok();
    run.plan.memory =
        memory_of(run, context,
                  scratch_bytes(run.plan.accumulation.bytes, bytes_of_thread(run), sums_ring(run)));
    add_picture_rows(context, run.thin, run);
    add_solid_rows(*run.scene, context.limits, run.world->solids, run.environment.depth,
                   run.plan.memory);
    PILEUS_TRY(
        check_limit(context.limits, LimitId::kMemory, run.plan.memory.peak(), run.scene->file));
    for (Stage stage : kUnused) run.plan.skip(stage);
    const bool open = run.budget.seconds > 0;
    run.plan.work = estimate_work(medium_work(run.world->medium, run.world->source.mean_density,
                                              double(run.max_events), open ? 0 : double(photons)));
    note_limits(*run.scene, run.world->medium.grid, context.limits,
                {LimitId::kVoxels, LimitId::kPhotons, LimitId::kPixels, LimitId::kFrames,
                 LimitId::kMemory, LimitId::kScatterings, LimitId::kWork},
                run.plan);
    return check_work(run.plan.work, context.limits, run.scene->file);
}

}  // namespace pileus
