// SPDX-License-Identifier: Apache-2.0
// Whether a scene is one that the method draws; in no flight, whose scenes were checked when they
// were packed. in: a scene, a budget -> out: one line. docs/architecture.md, "Refusals"
#include "src/methods/check_support.h"
#include "src/methods/photon_grid/photon_grid_method.h"
#include "src/photons/lit_march.h"
#include "src/scene/frames.h"

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
    for (const MediumSettings& m : scene.media) periodic |= m.box.periodic;
    if (periodic && !scene.camera.orthographic)
        return Status::bad_input(where +
                                 "not for periodic media, allowed: sh, or an orthographic camera");
    const char* mover = mover_of_view(scene);
    if (closure == GridClosure::kCamera && mover != nullptr)
        return Status::bad_input(where + "\"camera\" needs a fixed camera, but " + mover +
                                 " moves it");
    return Status::ok();
}

}  // namespace

Status check_photon_grid(const Scene& scene, const Budget& budget) {
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

Status PhotonGridMethod::check(const Context&, const FrameView& view) {
    return check_thinned(view.scene, "photon_grid", state_);
}

}  // namespace pileus
