// SPDX-License-Identifier: Apache-2.0
// Weighs a run before it is prepared and again after: memory, work, bounds of its sums, limits.
// in: CollectorsState, outlined or prepared -> out: its plan's figures; kLimit where one is too
// many. docs/report.md, "Plan"; docs/program.md, "Limits".
#include "src/methods/collectors/collectors_memory.h"
#include "src/methods/collectors/prepare/tree.h"
#include "src/photons/lit_march.h"
#include "src/photons/photon_report.h"
#include "src/run/on_device.h"
#include "src/world/majorant/majorant.h"

namespace pileus {
namespace {

/// Leaves, collectors and blocks: counted after preparation, bounded before.
void size_prepared(const FrameView& view, const CollectorsState& state, const Context& context,
                   CollectorsSizes& s) {
    const CollectorSettings& settings = state.settings;
    if (!state.outlined_only) {
        s.prepared.leaves = state.prepared.leaves.size();
        s.prepared.collectors = state.prepared.collectors.size();
        s.prepared.samples = state.prepared.samples;
        s.prepared.tracking_blocks = state.majorants.tracking.size();
        return;
    }
    s.prepared.samples = std::uint64_t(settings.placement.samples);
    const std::uint64_t most = context.limits[LimitId::kLeaves];
    if (s.prepared.cells)
        s.prepared.leaves = block_total(s.grid, state.camera_cells);
    else
        s.prepared.leaves = most > 0 ? most
                                     : expected_leaves(s.grid, leaf_share(view.world.medium),
                                                       max_extinction(view.world.medium),
                                                       settings.photons, s.prepared.samples);
    s.prepared.collectors = s.prepared.leaves;
    s.prepared.tracking_blocks = most_tracking_blocks(s.grid, settings.local_tracking);
}

}  // namespace

CollectorsSizes collectors_sizes(const FrameView& view, const CollectorsState& state,
                                 const Context& context) {
    const CollectorSettings& settings = state.settings;
    CollectorsSizes s;
    s.grid = view.world.medium.grid;
    s.source = view.world.source;
    s.threads = std::uint64_t(context.threads);
    s.media = std::uint64_t(view.world.medium.count);
    s.prepared.cells = state.camera_cells > 0;
    s.prepared.variance = settings.placement.variance_field;
    s.prepared.rejection = settings.placement.rejection_sampler;
    s.prepared.paper = settings.paper;
    s.photons.channels = std::uint64_t(state.lights.deposit.channels);
    s.photons.coefficients = std::uint64_t(state.lights.deposit.coefficients);
    s.photons.lights = state.lights.lighting.lights.size();
    s.phases = phase_bytes(view.world.medium);
    s.sky = sky_map_bytes(view.environment.sky_map, view.environment.look);
    s.photons.slots = photon_slots(state);
    s.photons.sums_ring = sums_ring(state);
    s.photons.ground_cells =
        std::uint64_t(state.lights.ground_map.cells) * std::uint64_t(state.lights.ground_map.cells);
    s.shoots_again = context.frames > 1;
    size_prepared(view, state, context, s);
    collectors_size_display(view, state, context, s);
    return s;
}

std::uint64_t bytes_of_sums(const CollectorsSizes& s) {
    return sum_of_bytes(arrays::photon_slot(collectors_slot(s), 1).bytes(), 256);
}

Status measure_collectors(const Context& context, const FrameView& view, CollectorsState& state,
                          Plan& plan) {
    const Scene& scene = view.scene;
    const double max_events = double(state.lights.max_events);
    const std::uint64_t photons = photons_of_run(state, context);
    plan.bounds = {collectors_bound(view, state)};
    PILEUS_TRY(check_limit(context.limits, LimitId::kPhotons, photons, scene.file));
    bound_ledgers(double(photons), max_events, plan);
    PILEUS_TRY(check_bounds(plan, scene.file, "collectors.photons"));
    CollectorsSizes sizes = collectors_sizes(view, state, context);
    plan.exact = !state.outlined_only;
    plan.accumulation = plan_accumulation(
        state.settings.accumulation, {sizes.threads, bytes_of_sums(sizes), collectors_peak(sizes),
                                      context.limits[LimitId::kMemory], plan.exact});
    if (on_device(context.kernels->device))
        plan.accumulation = {"shared", "all threads of the device add to one set", 0, true};
    state.ring.shared_sums = plan.accumulation.shared;
    return measure_memory(context, view, state, sizes, plan);
}

}  // namespace pileus
