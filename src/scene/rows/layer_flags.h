// SPDX-License-Identifier: Apache-2.0
// Layers of a picture beside radiance and alpha: their names, and what wants each.
// in: nothing -> out: one row each. docs/scene.md, "output.layers".
#pragma once
#include "src/scene/scene.h"

namespace pileus {

struct LayerFlag {
    const char* name;
    bool OutputSettings::*wanted;
};
constexpr LayerFlag kLayerFlags[] = {{"depth", &OutputSettings::layer_depth},
                                     {"error", &OutputSettings::layer_error},
                                     {"cloud", &OutputSettings::layer_cloud},
                                     {"optical_depth", &OutputSettings::layer_optical_depth},
                                     {"transmittance", &OutputSettings::layer_transmittance},
                                     {"light", &OutputSettings::layer_light},
                                     {"order", &OutputSettings::layer_order},
                                     {"reflectance", &OutputSettings::layer_reflectance},
                                     {"shadow", &OutputSettings::layer_shadow},
                                     {"occlusion", &OutputSettings::layer_occlusion}};

}  // namespace pileus
