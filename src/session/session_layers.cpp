// SPDX-License-Identifier: Apache-2.0
// Layers of a live session's picture, in the host's memory.
// in: a picture's planes, channels by their names -> out: their floats. docs/formats.md, "Pictures
// out"; docs/embedding.md, "Layers"
#include <algorithm>
#include <cstring>

#include "src/picture/finish_frame.h"
#include "src/session/deliver.h"
#include "src/session/session.h"

namespace pileus {
namespace {

/// Names of channels, those that begin a name marked, and what has them made; null: every picture
/// has them.
struct LayerName {
    const char* name;
    bool OutputSettings::*wanted;
    bool begins = false;

    bool fits(const std::string& text) const {
        return begins ? text.compare(0, std::strlen(name), name) == 0 : text == name;
    }
};
constexpr LayerName kNames[] = {{"R", nullptr},
                                {"G", nullptr},
                                {"B", nullptr},
                                {"A", nullptr},
                                {"Z", &OutputSettings::layer_depth},
                                {"cloud.", &OutputSettings::layer_cloud, true},
                                {"tau", &OutputSettings::layer_optical_depth},
                                {"T", &OutputSettings::layer_transmittance},
                                {"sun.", &OutputSettings::layer_light, true},
                                {"sky.", &OutputSettings::layer_light, true},
                                {"lamp", &OutputSettings::layer_light, true},
                                {"emission.", &OutputSettings::layer_light, true},
                                {"single.", &OutputSettings::layer_order, true},
                                {"multiple.", &OutputSettings::layer_order, true},
                                {"reflectance.", &OutputSettings::layer_reflectance, true},
                                {"shadow", &OutputSettings::layer_shadow},
                                {"occlusion", &OutputSettings::layer_occlusion},
                                {"error.", &OutputSettings::layer_error, true}};

bool is_made(const LayerName& row, const OutputSettings& output) {
    return row.wanted == nullptr || output.*row.wanted;
}

Status unknown_layer(const std::string& name, std::size_t at, const std::string& known) {
    return Status::bad_input("frame.layers[" + std::to_string(at) + "].name: \"" + name +
                             "\", allowed: " + known);
}

}  // namespace

Status Session::check_layers(const std::vector<LayerTarget>& layers) const {
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const std::string& name = layers[i].name;
        const bool known = std::any_of(
            std::begin(kNames), std::end(kNames),
            [&](const LayerName& row) { return is_made(row, scene_.output) && row.fits(name); });
        if (known) continue;
        std::string list;
        for (const LayerName& row : kNames)
            if (is_made(row, scene_.output))
                list += std::string(row.name) + (row.begins ? "..., " : ", ");
        return unknown_layer(
            name, i,
            list + "and what output.layers of the scene adds where its host asked for layers");
    }
    return Status::ok();
}

Status Session::show_layers(const FrameView& view, const std::vector<LayerTarget>& layers,
                            const Planes& planes) {
    const StageClock clock(context_, "layers");
    PILEUS_TRY(made_.report->add_layers(context_, view));
    Image image;
    Report told;
    PILEUS_TRY(
        finish_layers(scene_.output, view.camera, world().medium.low_m, planes, image, told));
    PILEUS_TRY(add_surface_layers(scene_, *this, view.frame, image));
    report_.errors = told.errors;
    std::vector<const Channel*> from;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        from.push_back(image.find(layers[i].name.c_str()));
        if (from.back() != nullptr) continue;
        std::string known;
        for (const Channel& channel : image.channels)
            known += (known.empty() ? "" : ", ") + channel.name;
        return unknown_layer(layers[i].name, i, known);
    }
    const std::size_t width = std::size_t(image.width);
    for (std::size_t i = 0; i < layers.size(); ++i)
        for (int y = 0; y < image.height; ++y)
            std::memcpy(layers[i].rows.row(y, image.height),
                        from[i]->pixels.data() + std::size_t(y) * width, width * sizeof(float));
    return Status::ok();
}

}  // namespace pileus
