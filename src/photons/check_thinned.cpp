// SPDX-License-Identifier: Apache-2.0
// Whether a picture of photons may have fewer marched pixels; in no flight.
// in: a scene, its state -> out: one line. docs/upsampling.md
#include "src/photons/lit_march.h"

namespace pileus {

Status check_thinned(const Scene& scene, const char* method, const PhotonState& state) {
    const UpsampleSettings& thin = state.picture.thin;
    PILEUS_TRY(check_upsampling(scene, method, thin));
    if (thin.every() == 1) return Status::ok();
    const std::string key =
        scene.file + ": " + method + (thin.temporal > 0 ? ".temporal: " : ".scale: ");
    const OutputSettings& output = scene.output;
    const char* layer = state.error_layer    ? "error"
                        : output.layer_light ? "light"
                        : output.layer_order ? "order"
                                             : nullptr;
    if (layer != nullptr)
        return Status::bad_input(key + "the layer \"" + layer +
                                 "\" has every pixel marched, allowed: none of both, or no such "
                                 "layer");
    return Status::ok();
}

}  // namespace pileus
