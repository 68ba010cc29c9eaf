// SPDX-License-Identifier: Apache-2.0
// See photon_grid_method.h.
#include "src/methods/photon_grid/photon_grid_method.h"

#include "src/methods/scenery.h"
#include "src/photons/lit_march.h"
#include "src/world/camera/view.h"

namespace pileus {
namespace {

MadeMethod make(const MethodInputs& inputs) {
    auto method = std::make_unique<PhotonGridMethod>(inputs);
    MadeMethod made;
    made.report = photon_grid_report(*method);
    made.method = std::move(method);
    return made;
}

}  // namespace

PhotonGridMethod::PhotonGridMethod(const MethodInputs& inputs) : PhotonMethod(state_) {
    begin_photons(inputs, state_);
    state_.settings = inputs.scene.photon_grid;
    state_.ring.on = state_.settings.ring;
    state_.picture.thin = state_.settings.thin;
    state_.shadow.light_refresh = state_.settings.light_refresh;
    const std::int64_t budget = inputs.budget.photons;
    state_.lights.budget_photons = budget >= 0 ? budget : state_.settings.photons;
}

Status PhotonGridMethod::prepare(const Context& context, const FrameView& view) {
    const Medium& medium = view.world.medium;
    // The values may show that there is no medium, or more of it than sizes tell.
    Plan plan;
    PILEUS_TRY(choose_and_measure(context, view, plan));
    PILEUS_TRY(make_cell_majorants(medium, state_.settings.local_tracking, state_.cells, context,
                                   state_.majorants, state_.near));
    PILEUS_TRY(make_cell_shares(medium, state_.cells, state_.near.marks.span(), context.threads,
                                state_.shares));
    state_.outlined_only = false;
    PILEUS_TRY(measure(context, view, plan));
    return lay_out(context, view);
}

TraceInput PhotonGridMethod::trace_input(const Context& context, const FrameView& view) const {
    TraceInput in = photon_trace_input(context, view, state_);
    in.collectors = state_.cells.count();
    for (int a = 0; a < 3; ++a) in.cells.size[a] = state_.cells.size[a];
    in.cells.density = state_.near.least_density;
    return in;
}

/// The closure of a camera.
bool PhotonGridMethod::is_turned(const FrameView& view) const {
    if (state_.settings.closure != GridClosure::kCamera) return false;
    const CameraParams camera = make_camera(view.scene.camera, 0, view.world.medium.low_m);
    bool turned = false;
    for (int a = 0; a < 3; ++a)
        turned |= state_.lights.deposit.camera[a] !=
                  (view.scene.camera.orthographic ? -camera.forward[a] : camera.origin[a]);
    return turned;
}

Status PhotonGridMethod::compose(const Context& context, const FrameView& view, Planes& planes) {
    return compose_photon_grid(context, view, trace_input(context, view), state_, planes);
}

Status PhotonGridMethod::error(const Context& context, const FrameView& view,
                               double& mean_relative) {
    Planes planes;
    PILEUS_TRY(compose(context, view, planes));
    // Relative to the light that the picture has.
    PILEUS_TRY(show_air(context, view, planes));
    mean_relative = batch_error_sum(planes, view.camera.width, view.camera.height).mean_relative();
    return Status::ok();
}

MethodRow photon_grid_row() {
    return {"photon-grid", WorldUse::kGrid,   check_photon_grid, make, false,
            true,          Division::kPhotons};
}

}  // namespace pileus
