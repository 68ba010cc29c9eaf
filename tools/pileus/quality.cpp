// SPDX-License-Identifier: Apache-2.0
// See quality.h.
#include "tools/pileus/quality.h"

#include "src/scene/rows/layer_flags.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

namespace {

constexpr std::int64_t kDraftSamples = 4, kDraftPhotons = 100'000, kDraftSteps = 96;

std::string whole(const char* key, std::int64_t n) {
    return std::string(key) + "=" + std::to_string(n);
}
std::int64_t least(std::int64_t a, std::int64_t b) { return a < b ? a : b; }

/// The scene's layers but for two: a filtered picture's error takes four filters more, and parts of
/// its light it has not.
std::string filtered_layers(const OutputSettings& output) {
    std::string list = "\"radiance\", \"alpha\"";
    for (const LayerFlag& layer : kLayerFlags)
        if (output.*layer.wanted && layer.wanted != &OutputSettings::layer_error &&
            layer.wanted != &OutputSettings::layer_light)
            list += std::string(", \"") + layer.name + '"';
    return "output.layers=[" + list + "]";
}

void draft_sets(const Scene& scene, std::vector<std::string>& out) {
    const OutputSettings& layers = scene.output;
    // Thinned pictures have no layers of single lights and orders.
    const bool thin = !layers.layer_error && !layers.layer_light && !layers.layer_order;
    if (scene.method == "path") {
        out.push_back(
            whole("path.samples_per_pixel", least(kDraftSamples, scene.path.samples_per_pixel)));
        if (scene.camera.flux) return;
        out.push_back("filter.kind=\"regression\"");
        if (layers.layer_error || layers.layer_light) out.push_back(filtered_layers(layers));
    } else if (scene.method == "collectors") {
        out.push_back(whole("collectors.photons", least(kDraftPhotons, scene.collectors.photons)));
        if (!scene.collectors.billboards && !scene.collectors.paper)
            out.push_back("collectors.node_filter=\"guided\"");
    } else if (scene.method == "photon-grid") {
        out.push_back(
            whole("photon_grid.photons", least(kDraftPhotons, scene.photon_grid.photons)));
        if (thin && scene.photon_grid.thin.temporal == 0) out.push_back("photon_grid.scale=2");
    } else if (scene.method == "raymarch") {
        out.push_back(whole("raymarch.steps", least(kDraftSteps, scene.raymarch.steps)));
        if (thin && scene.raymarch.thin.temporal == 0) out.push_back("raymarch.scale=2");
    }
}

void final_sets(const Scene& scene, std::vector<std::string>& out) {
    out.push_back("filter.kind=\"none\"");
    const std::string table = scene.method == "photon-grid" ? "photon_grid" : scene.method;
    if (table != "collectors" && table != "photon_grid" && table != "raymarch") return;
    if (table == "collectors" && scene.collectors.billboards) return;
    out.push_back(table + ".scale=1");
    out.push_back(table + ".temporal=0");
}

}  // namespace

Status quality_sets(const std::string& quality, const Scene& scene,
                    const std::vector<std::string>& sets, std::vector<std::string>& out) {
    std::vector<std::string> all;
    if (quality == "draft")
        draft_sets(scene, all);
    else if (quality == "final")
        final_sets(scene, all);
    else
        return Status::bad_input("--quality: unknown, " + quote_text(quality) +
                                 ", allowed: draft, final");
    for (const std::string& set : all) {
        bool typed = false;
        const std::string key = set.substr(0, set.find('=') + 1);
        for (const std::string& own : sets) typed = typed || own.compare(0, key.size(), key) == 0;
        if (!typed) out.push_back(set);
    }
    return Status::ok();
}

}  // namespace pileus
