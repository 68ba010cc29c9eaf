// SPDX-License-Identifier: Apache-2.0
// Layers of a picture beside radiance and alpha: their names, what wants each, who makes it.
// in: nothing -> out: one row each. docs/scene.md, "output.layers".
#pragma once
#include "src/methods/support.h"
#include "src/scene/scene.h"

namespace pileus {

struct LayerFlag {
    const char* name;
    bool OutputSettings::*wanted;
    Feature feature;  ///< of the support table, whose words refuse it
};
constexpr LayerFlag kLayerFlags[] = {
    {"depth", &OutputSettings::layer_depth, Feature::kLayerDepth},
    {"error", &OutputSettings::layer_error, Feature::kLayerError},
    {"cloud", &OutputSettings::layer_cloud, Feature::kLayerCloud},
    {"optical_depth", &OutputSettings::layer_optical_depth, Feature::kLayerTau},
    {"transmittance", &OutputSettings::layer_transmittance, Feature::kLayerTau},
    {"light", &OutputSettings::layer_light, Feature::kLayerLight},
    {"order", &OutputSettings::layer_order, Feature::kLayerOrder},
    {"reflectance", &OutputSettings::layer_reflectance, Feature::kLayerShadow},
    {"shadow", &OutputSettings::layer_shadow, Feature::kLayerShadow},
    {"occlusion", &OutputSettings::layer_occlusion, Feature::kLayerOcclusion}};

}  // namespace pileus
