// SPDX-License-Identifier: Apache-2.0
// Weighs a run of the photon grid: memory, work, bounds of its sums, limits.
// in: PhotonGridState, outlined or prepared -> out: its plan; kLimit where something is too much.
// docs/report.md, "Plan"; docs/photon-grid.md, "Memory".
#include "src/methods/photon_grid/photon_grid_state.h"
#include "src/photons/lit_march.h"
#include "src/photons/photon_report.h"
#include "src/run/on_device.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

using Size = std::uint64_t;

/// All that the scene asks for; where time decides, what the sums hold at most is no work to come.
Size all_photons(const PhotonGridState& state, const Context& context) {
    if (state.ring.on) return photons_of_run(state, context);
    Size generation = 0;
    for (const Light& light : state.lights.lighting.lights) generation += light.photons;
    return bytes_of(generation, planned_generations(state), context.frames);
}

}  // namespace

SlotSize grid_slot(const PhotonGridState& state) {
    return {state.cells.count(), Size(state.lights.deposit.channels),
            Size(state.lights.deposit.coefficients),
            Size(state.lights.ground_map.cells) * Size(state.lights.ground_map.cells)};
}

std::uint64_t bytes_of_grid_thread(const PhotonGridState& state) {
    return sum_of_bytes(arrays::photon_slot(grid_slot(state), 1).bytes(), 256);
}

Status measure_photon_grid(const Context& context, const FrameView& view, PhotonGridState& state,
                           Plan& plan) {
    const Scene& scene = view.scene;
    const double max_events = double(state.lights.max_events);
    const Size photons = all_photons(state, context);
    plan.bounds = {grid_bound(view, state)};
    PILEUS_TRY(check_limit(context.limits, LimitId::kPhotons, photons, scene.file));
    const double most = double(photons) > state.most_photons ? double(photons) : state.most_photons;
    bound_ledgers(most, max_events, plan);
    PILEUS_TRY(check_bounds(plan, scene.file, "photon_grid.photons"));
    plan.exact = !state.outlined_only;
    plan.accumulation = plan_accumulation(
        state.settings.accumulation,
        {Size(context.threads), bytes_of_grid_thread(state), photon_grid_peak(context, view, state),
         context.limits[LimitId::kMemory], plan.exact});
    if (on_device(context.kernels->device))
        plan.accumulation = {"shared", "all threads of the device add to one set", 0, true};
    state.ring.shared_sums = plan.accumulation.shared;
    return measure_grid_memory(context, view, state, photons, plan);
}

}  // namespace pileus
