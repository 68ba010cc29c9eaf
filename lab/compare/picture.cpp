// SPDX-License-Identifier: Apache-2.0
// Reads a picture of any program's, and develops one.
// in: channels of any name -> out: R G B A and error.R/G/B.
// docs/compare.md, "Foreign files"
#include "lab/compare/picture.h"

#include <vector>

#include "src/io/images/srgb.h"
#include "src/scene/rows/picture_format.h"

namespace pileus {

Status read_picture(const std::string& path, const std::string& layer, Image& image,
                    std::string& said) {
    const PictureFormat* format = picture_format_of(path);
    if (format != nullptr && is_read(*format) && !format->radiance) {
        PILEUS_TRY(decode_image(*format, path, image, kMaxImagePixels));
        said = "light of a display";
    } else {
        PILEUS_TRY(read_image(path, image));
    }
    std::string chosen;
    PILEUS_TRY(choose_layer(path, layer, image, chosen));
    if (!chosen.empty()) said = "layer " + printable_line(chosen);
    if (image.find("Y") != nullptr) said += said.empty() ? "grey" : ", grey";
    // Of a part of a picture of ours the pixels are compared that it has.
    if (!image.pixel_hash.empty()) return Status::ok();
    const int width = image.width, height = image.height;
    PILEUS_TRY(fit_display_window(path, image));
    if (image.width != width || image.height != height)
        said += (said.empty() ? "" : ", ") + std::to_string(width) + " x " +
                std::to_string(height) + " pixels laid into the display window";
    return Status::ok();
}

Status develop_image(const ToneSettings& tone, Image& image) {
    if (image.display_colours) return Status::ok();
    Buffer<std::uint8_t> rgb;
    PILEUS_TRY(tone_map_8bit(image, tone, rgb));
    float light[256];
    for (int code = 0; code < 256; ++code) light[code] = float(linear_of_srgb(code / 255.0));
    std::vector<Channel> channels(3);
    const char* const names[3] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) {
        channels[c].name = names[c];
        PILEUS_TRY(channels[c].pixels.resize(rgb.size() / 3, "developed picture"));
        for (std::size_t i = 0; i < rgb.size() / 3; ++i)
            channels[c].pixels[i] = light[rgb[3 * i + c]];
    }
    for (Channel& channel : image.channels)
        if (channel.name == "A") channels.push_back(std::move(channel));
    image.channels = std::move(channels);
    image.display_colours = true;
    return Status::ok();
}

}  // namespace pileus
