// SPDX-License-Identifier: Apache-2.0
// See photon_grid_method.h.
#include "src/methods/photon_grid/photon_grid_method.h"

#include "kernels_cpu/core/profile.h"
#include "src/methods/check_support.h"
#include "src/photons/lit_march.h"
#include "src/world/camera/view.h"

namespace pileus {
namespace {

Status check_layers(const Scene& scene) {
    if (scene.output.layer_order && scene.sun.present && !scene.photon_grid.first_order_split)
        return Status::bad_input(scene.file +
                                 ": output.layers: \"order\": method photon-grid keeps single "
                                 "scattering apart only with first_order_split, allowed: "
                                 "photon_grid.first_order_split = true, or no such layer");
    return Status::ok();
}

/// A periodic medium is seen from many sides at once, a moved camera as well.
Status check_closure(const Scene& scene) {
    const GridClosure closure = scene.photon_grid.closure;
    if (closure == GridClosure::kSh) return Status::ok();
    const std::string where = scene.file + ": photon_grid.closure: ";
    bool periodic = false;
    for (const MediumSettings& m : scene.media) periodic |= m.periodic;
    if (periodic && !scene.camera.orthographic)
        return Status::bad_input(where +
                                 "not for periodic media, allowed: sh, or an orthographic camera");
    const char* mover = mover_of_view(scene);
    if (closure == GridClosure::kCamera && mover != nullptr)
        return Status::bad_input(where + "\"camera\" needs a fixed camera, but " + mover +
                                 " moves it");
    return Status::ok();
}

Status check_scene(const Scene& scene, const Budget& budget) {
    if (budget.error > 0 && !scene.output.layer_error)
        return Status::bad_input(
            "--budget error: method photon-grid knows its error by batches of photons, allowed: "
            "output.layers with \"error\"");
    if (budget.error > 0 && scene.animation.present)
        return Status::bad_input(
            "--budget error: not for an animation by photon-grid, whose frames have the same "
            "photons, "
            "allowed: photons=N");
    PILEUS_TRY(check_budget_kinds(scene, budget));
    PILEUS_TRY(check_layers(scene));
    return check_closure(scene);
}

MadeMethod make(const MethodInputs& inputs) {
    auto method = std::make_unique<PhotonGridMethod>(inputs);
    MadeMethod made;
    if (kPlans) made.report = photon_grid_report(*method);
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

Status PhotonGridMethod::check(const Context& context, const FrameView& view) {
    if (kDevices && context.kernels->device != nullptr)
        return Status::bad_input(std::string("--isa: \"") + context.kernels->name +
                                 "\": method photon-grid runs on the host alone, allowed: another, "
                                 "or another method");
    if (!kChecks) return Status::ok();
    return check_thinned(context, view.scene, "photon_grid", state_);
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

Status PhotonGridMethod::compose(const Context& context, const FrameView& view,
                                 const CameraParams& camera, Planes& planes) {
    return compose_photon_grid(camera, context, view, trace_input(context, view), state_, planes);
}

Status PhotonGridMethod::error(const Context& context, const FrameView& view,
                               double& mean_relative) {
    const CameraParams camera =
        make_camera(view.scene.camera, orbit_at(view.scene, view.frame), view.world.medium.low_m);
    Planes planes;
    PILEUS_TRY(compose(context, view, camera, planes));
    mean_relative = batch_error_sum(planes).mean_relative();
    return Status::ok();
}

MethodRow photon_grid_row() {
    return {"photon-grid", WorldUse::kGrid, kept(kChecks, check_scene), make};
}

}  // namespace pileus
