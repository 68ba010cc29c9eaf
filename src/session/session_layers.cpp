// SPDX-License-Identifier: Apache-2.0
// Layers of a live session's picture, in the host's memory.
// in: a picture's planes, channels by their names -> out: their floats. docs/formats.md, "Pictures
// out"; docs/embedding.md, "Layers"
#include "src/picture/finish_frame.h"
#include "src/session/deliver.h"
#include "src/session/session.h"

namespace pileus {
namespace {

Status unknown_layer(const std::string& name, std::size_t at, const Image& image) {
    std::string known;
    for (const Channel& channel : image.channels)
        known += (known.empty() ? "" : ", ") + channel.name;
    return Status::bad_input("frame.layers[" + std::to_string(at) + "].name: \"" + name +
                             "\", allowed: " + known +
                             ", and what output.layers of the scene adds to them");
}

}  // namespace

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
        if (from.back() == nullptr) return unknown_layer(layers[i].name, i, image);
    }
    const std::size_t width = std::size_t(image.width);
    for (std::size_t i = 0; i < layers.size(); ++i)
        for (int y = 0; y < image.height; ++y)
            std::memcpy(layers[i].rows.row(y, image.height),
                        from[i]->pixels.data() + std::size_t(y) * width, width * sizeof(float));
    return Status::ok();
}

}  // namespace pileus
