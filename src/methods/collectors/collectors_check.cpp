// SPDX-License-Identifier: Apache-2.0
// Whether a scene is one that the method draws; in no flight, whose scenes were checked when they
// were packed. in: a scene, a budget -> out: one line. docs/architecture.md, "Refusals"
#include "src/methods/check_support.h"
#include "src/methods/collectors/billboards/gl_billboards.h"
#include "src/methods/collectors/collectors_method.h"
#include "src/photons/lit_march.h"
#include "src/scene/frames.h"
#include "src/world/plan_parts.h"

namespace pileus {

Status check_collectors(const Scene& scene, const Budget& budget) {
    PILEUS_TRY(check_budget_kinds(scene, budget));
    const CollectorSettings& settings = scene.collectors;
    if (scene.output.layer_order && scene.sun.present && !settings.first_order_split &&
        !settings.closure.camera)
        return Status::bad_input(scene.file +
                                 ": output.layers: \"order\": method collectors keeps single "
                                 "scattering apart only with first_order_split, allowed: "
                                 "collectors.first_order_split = true, or no such layer");
    return Status::ok();
}

Status CollectorsMethod::check(const Context&, const FrameView& view) {
    const Scene& scene = view.scene;
    const CollectorSettings& settings = state_.settings;
    PILEUS_TRY(check_thinned(scene, "collectors", state_));
    if (settings.thin.every() > 1 && !is_marched(state_))
        return Status::bad_input(scene.file +
                                 ": collectors.display: \"billboards\" has no marched pixels, "
                                 "allowed: march, or collectors.scale = 1 and temporal = 0");
    if (settings.closure.camera) {
        if (const char* const mover = mover_of_view(scene))
            return Status::bad_input(scene.file +
                                     ": collectors.closure: \"camera\" needs a fixed "
                                     "camera, but " +
                                     mover + " moves it");
    }
    // Tell before any work that the compositor asked for is not here.
    if (settings.display.compositor != Compositor::kBuiltin) {
        GlBlender blender;
        PILEUS_TRY(open_gl_blender(settings.display.compositor, blender));
    }
    return Status::ok();
}

}  // namespace pileus
