// SPDX-License-Identifier: Apache-2.0
// What programs ask of method `path` besides pictures.
// in: a scene -> out: settings of other qualities.
// docs/program.md, "Quality"
#include "src/methods/path/path_method.h"
#include "src/scene/rows/layer_flags.h"

namespace pileus {
namespace {

constexpr std::int64_t kDraftSamples = 4;

/// The scene's layers but for three: a filtered picture's error takes four filters more, and parts
/// of its light it has not.
std::string filtered_layers(const OutputSettings& output) {
    std::string list = "\"radiance\", \"alpha\"";
    for (const LayerFlag& layer : kLayerFlags)
        if (output.*layer.wanted && layer.wanted != &OutputSettings::layer_error &&
            layer.wanted != &OutputSettings::layer_light &&
            layer.wanted != &OutputSettings::layer_order)
            list += std::string(", \"") + layer.name + '"';
    return "output.layers=[" + list + "]";
}

void path_draft(const Scene& scene, std::vector<std::string>& sets) {
    const OutputSettings& layers = scene.output;
    sets.push_back(
        at_most_text("path.samples_per_pixel", scene.path.samples_per_pixel, kDraftSamples));
    if (scene.camera.flux) return;
    sets.push_back("filter.kind=\"regression\"");
    if (layers.layer_error || layers.layer_light || layers.layer_order)
        sets.push_back(filtered_layers(layers));
}

}  // namespace

const MethodTools path_tools{path_draft, nullptr, nullptr, nullptr, false};

}  // namespace pileus
