// SPDX-License-Identifier: Apache-2.0
// See collectors_method.h.
#include "src/methods/collectors/collectors_method.h"

namespace pileus {
namespace {

MadeMethod make(const MethodInputs& inputs) {
    auto method = std::make_unique<CollectorsMethod>(inputs);
    MadeMethod made;
    made.report = collectors_report(*method);
    made.method = std::move(method);
    return made;
}

}  // namespace

CollectorsMethod::CollectorsMethod(const MethodInputs& inputs, const CollectorSettings& settings)
    : PhotonMethod(state_) {
    begin_photons(inputs, state_);
    state_.settings = settings;
    state_.picture.thin = settings.thin;
    state_.picture.thins = !settings.display.billboards;
    state_.shadow.light_refresh = settings.light_refresh;
    const std::int64_t budget = inputs.budget.photons;
    state_.lights.budget_photons = budget >= 0 ? budget : settings.photons;
    if (settings.closure.camera) state_.camera_cells = settings.closure.cell_voxels;
}

Status CollectorsMethod::prepare(const Context& context, const FrameView& view) {
    const Medium& medium = view.world.medium;
    const CollectorSettings& settings = state_.settings;
    // The values may show that there is no medium, or more of it than sizes tell.
    Plan plan;
    PILEUS_TRY(choose_and_measure(context, view, plan));
    PILEUS_TRY(
        state_.camera_cells > 0
            ? prepare_cells(medium, state_.camera_cells, context, state_.prepared)
            : prepare_collectors(medium, settings, view.scene.seed, context, state_.prepared));
    state_.cell_m = state_.prepared.cell_m;
    PILEUS_TRY(make_photon_majorants(medium, settings.local_tracking, context, state_.majorants));
    state_.outlined_only = false;
    PILEUS_TRY(measure(context, view, plan));
    return lay_out(context, view);
}

Status CollectorsMethod::worst_case(const FrameView& view, const FrameWork& work,
                                    FrameUnits& units) const {
    if (state_.settings.display.billboards)
        return Status::bad_input(
            "units: what billboards take depends on the view, allowed: display = \"march\"");
    return PhotonMethod::worst_case(view, work, units);
}

void CollectorsMethod::count(Counts& counts) const {
    PhotonMethod::count(counts);
    counts.emplace_back("samples_given_up", state_.prepared.rejected);
}

const char* CollectorsMethod::fixed_view() const {
    if (!state_.settings.closure.camera) return nullptr;
    return "collectors.closure \"camera\" lights cells towards a fixed one, allowed: another "
           "closure";
}

void CollectorsMethod::release(Phase phase) {
    PhotonMethod::release(phase);
    if (phase == Phase::kEnded) state_.prepared.collector_of_voxel = Buffer<std::int32_t>();
}

TraceInput CollectorsMethod::trace_input(const Context& context, const FrameView& view) const {
    TraceInput in = photon_trace_input(context, view, state_);
    in.collector_of_voxel = state_.prepared.collector_of_voxel.span();
    in.collectors = state_.prepared.collectors.size();
    return in;
}

Status CollectorsMethod::compose(const Context& context, const FrameView& view, Planes& planes) {
    return compose_collectors(context, view, trace_input(context, view), state_, planes);
}

MethodRow collectors_row() {
    return {kCollectorsName,   WorldUse::kGrid, check_collectors, make, false, true,
            Division::kPhotons};
}

}  // namespace pileus
