// SPDX-License-Identifier: Apache-2.0
// Whether a scene is one that the method draws; in no flight, whose scenes were checked when they
// were packed. in: a scene, a budget -> out: one line. docs/architecture.md, "Refusals"
#include "src/methods/check_support.h"
#include "src/methods/path/path_method.h"
#include "src/picture/filter/oidn.h"

namespace pileus {
namespace {

std::string key_of(const Scene& scene) { return scene.file + ": filter.kind: "; }

Status check_path_filter(const Scene& scene) {
    if (!path_filters(scene.filter)) return Status::ok();
    const std::string key = key_of(scene);
    const std::string value = std::string("\"") + path_filter_name(scene.filter) + "\"";
    if (scene.camera.flux)
        return Status::bad_input(key +
                                 "a flat detector (camera.projection \"flux\") sees along no "
                                 "single ray, " +
                                 value + ", allowed: none");
    const OutputSettings& output = scene.output;
    // What the media turned takes the picture's change whole; its parts have no share of their own,
    // and a library's filter does not tell the media from what is behind.
    const bool regresses = path_regresses(scene.filter);
    const char* layer = output.layer_error && !regresses   ? "error"
                        : output.layer_cloud && !regresses ? "cloud"
                        : output.layer_light               ? "light"
                        : output.layer_order               ? "order"
                                                           : nullptr;
    if (layer != nullptr)
        return Status::bad_input(key + "a filtered picture has no layer \"" + layer + "\", " +
                                 value + ", allowed: none, or other layers");
    return regresses ? Status::ok() : check_oidn(key);
}

}  // namespace

Status check_path(const Scene& scene, const Budget& budget) {
    PILEUS_TRY(check_budget_kinds(scene, budget));
    const OutputSettings& output = scene.output;
    if (scene.camera.flux &&
        (output.layer_depth || output.layer_optical_depth || output.layer_transmittance))
        return Status::bad_input(scene.file +
                                 ": output.layers: a flat detector (camera.projection \"flux\") "
                                 "sees along no single ray, allowed: radiance, alpha, error, "
                                 "cloud, light, order");
    return check_path_filter(scene);
}

Status denoise_film(const Context& context, const FrameView& view, PathState& state) {
    return denoise_by_oidn(key_of(view.scene), state.film.width, state.film.height, context.threads,
                           state.planes.colour.data());
}

}  // namespace pileus
