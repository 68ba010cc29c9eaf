// SPDX-License-Identifier: Apache-2.0
// Weighs a run before it is prepared and again after: memory, work, bounds of its sums, limits.
// in: CollectorsRun, outlined or prepared -> out: its plan's figures; kLimit where one is too many.
// docs/report.md, "Plan"; docs/program.md, "Limits".
#include "kernels_cpu/core/profile.h"
#include "src/methods/collectors/collectors_memory.h"
#include "src/methods/collectors/prepare/tree.h"
#include "src/photons/lit_march.h"
#include "src/photons/photon_report.h"
#include "src/world/majorant/majorant.h"

namespace pileus {
namespace {

/// Leaves, collectors and blocks: counted after preparation, bounded before.
void size_prepared(const CollectorsRun& run, const Context& context, CollectorsSizes& s) {
    const CollectorSettings& settings = run.settings;
    if (!run.outlined_only) {
        s.leaves = run.prepared.leaves.size();
        s.collectors = run.prepared.collectors.size();
        s.samples = run.prepared.samples;
        s.tracking_blocks = run.majorants.tracking.size();
        return;
    }
    s.samples = std::uint64_t(settings.samples);
    const std::uint64_t most = context.limits[LimitId::kLeaves];
    if (s.cells)
        s.leaves = block_total(s.grid, run.camera_cells);
    else
        s.leaves =
            most > 0 ? most : expected_leaves(s.grid, leaf_share(run.world->medium), s.samples);
    s.collectors = s.leaves;
    s.tracking_blocks = most_tracking_blocks(s.grid, settings.local_tracking);
}

}  // namespace

CollectorsSizes collectors_sizes(const CollectorsRun& run, const Context& context) {
    const CollectorSettings& settings = run.settings;
    CollectorsSizes s;
    s.grid = run.world->medium.grid;
    s.source = run.world->source;
    s.threads = std::uint64_t(context.threads);
    s.media = std::uint64_t(run.world->medium.count);
    s.cells = run.camera_cells > 0;
    s.variance = settings.variance_field;
    s.rejection = settings.rejection_sampler;
    s.paper = settings.paper;
    s.channels = std::uint64_t(run.deposit.channels);
    s.coefficients = std::uint64_t(run.deposit.coefficients);
    s.lights = run.lighting.lights.size();
    s.phases = phase_bytes(run.world->medium);
    s.sky = sky_map_bytes(run.environment.sky_map);
    s.slots = photon_slots(run);
    s.sums_ring = sums_ring(run);
    s.ground_cells = std::uint64_t(run.ground_map.cells) * std::uint64_t(run.ground_map.cells);
    s.shoots_again = context.frames > 1;
    size_prepared(run, context, s);
    collectors_size_display(run, context, s);
    return s;
}

Status collectors_measure(const Context& context, CollectorsRun& run) {
    const std::uint64_t photons = photons_of_run(run, context);
    PILEUS_TRY(check_limit(context.limits, LimitId::kPhotons, photons, run.scene->file));
    bound_ledgers(double(photons), double(run.max_events), run.plan);
    PILEUS_TRY(check_bounds(run.plan, run.scene->file, "collectors.photons"));
    CollectorsSizes sizes = collectors_sizes(run, context);
    run.plan.exact = !run.outlined_only;
    run.plan.accumulation =
        plan_accumulation(run.settings.accumulation,
                          {sizes.threads, bytes_of_sums(sizes), collectors_memory(sizes).peak(),
                           context.limits[LimitId::kMemory], run.plan.exact});
    if (kDevices && context.kernels->device != nullptr)
        run.plan.accumulation = {"shared", "all threads of the device add to one set", 0, true};
    if (!kPlans) return Status::ok();
    sizes.private_sums =
        scratch_bytes(run.plan.accumulation.bytes, bytes_of_sums(sizes), sizes.sums_ring);
    run.plan.memory = collectors_memory(sizes);
    add_picture_rows(context, run.thin, run);
    add_solid_rows(*run.scene, context.limits, run.world->solids, run.environment.depth,
                   run.plan.memory);
    PILEUS_TRY(
        check_limit(context.limits, LimitId::kMemory, run.plan.memory.peak(), run.scene->file));
    run.plan.skip(Stage::kPaths);
    run.plan.work = estimate_work(medium_work(run.world->medium, run.world->source.mean_density,
                                              double(run.max_events), double(photons)));
    collectors_note_limits(context, run);
    return check_work(run.plan.work, context.limits, run.scene->file);
}

void collectors_note_limits(const Context& context, CollectorsRun& run) {
    note_limits(*run.scene, run.world->medium.grid, context.limits,
                {LimitId::kVoxels, LimitId::kSamples, LimitId::kPhotons, LimitId::kPixels,
                 LimitId::kFrames, LimitId::kMemory, LimitId::kScatterings, LimitId::kWork},
                run.plan);
}

}  // namespace pileus
