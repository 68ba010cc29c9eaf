// SPDX-License-Identifier: Apache-2.0
// Whether a scene is one that the method draws; in no flight, whose scenes were checked when they
// were packed. in: a scene, a budget -> out: one line. docs/architecture.md, "Refusals"
#include "src/methods/check_support.h"
#include "src/methods/march/march_method.h"
#include "src/scene/method_column.h"

namespace pileus {
namespace {

Status check_march_parts(const Scene& scene) {
    const OutputSettings& output = scene.output;
    const UpsampleSettings& thin = scene.raymarch.thin;
    const bool thins = refused(scene, Feature::kThinning) == nullptr && thin.every() > 1;
    if (!thins || !(output.layer_light || output.layer_order)) return Status::ok();
    return Status::bad_input(scene.file + ": raymarch." +
                             (thin.temporal > 0 ? "temporal" : "scale") + ": the layer \"" +
                             (output.layer_light ? "light" : "order") +
                             "\" has every pixel marched, allowed: none of both, or no such layer");
}

Status check_marched(const Scene& scene, const Budget& budget) {
    PILEUS_TRY(check_budget_kinds(scene, budget));
    if (scene.camera.flux)
        return Status::bad_input(scene.file +
                                 ": camera.projection: \"flux\" sees along no single ray, which "
                                 "method " +
                                 scene.method + " marches, allowed: perspective, orthographic");
    PILEUS_TRY(check_layer_kinds(scene));
    return check_march_parts(scene);
}

}  // namespace

Status check_raymarch(const Scene& scene, const Budget& budget) {
    PILEUS_TRY(check_marched(scene, budget));
    const RaymarchLightKind light = scene.raymarch.light.kind;
    if (scene.raymarch.light.cone &&
        (light == RaymarchLightKind::kBuffer || light == RaymarchLightKind::kBufferExact))
        return Status::bad_input(scene.file +
                                 ": raymarch.light: nodes hold straight ways, not those of "
                                 "light_path = \"cone\", allowed: auto, march");
    return check_upsampling(scene, "raymarch", scene.raymarch.thin);
}

Status check_optical_depth(const Scene& scene, const Budget& budget) {
    PILEUS_TRY(check_marched(scene, budget));
    if (scene.optical_depth.max_extinction_per_m > 0 && scene.media.size() > 1)
        return Status::bad_input(scene.file +
                                 ": optical_depth.max_extinction_per_m: not with several media, "
                                 "allowed: 0, or a scene with one");
    return Status::ok();
}

}  // namespace pileus
