// SPDX-License-Identifier: Apache-2.0
// A small picture with values that writers like to lose.
// in: a size -> out: an Image with R G B A, a named layer and an infinite depth.
// docs/testing.md
#pragma once
#include <doctest/doctest.h>

#include <limits>

#include "src/io/images/image_file.h"

namespace pileus {
namespace test {

inline Image make_image(int width, int height) {
    Image image;
    image.width = width;
    image.height = height;
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    for (const char* name : {"R", "G", "B", "A", "cloud.R", "Z"}) {
        image.channels.emplace_back();
        Channel& channel = image.channels.back();
        channel.name = name;
        REQUIRE(channel.pixels.resize(pixels, name));
        for (std::size_t i = 0; i < pixels; ++i)
            channel.pixels[i] = float(i) * 0.1f + float(image.channels.size());
    }
    image.channels[0].pixels[0] = 1e-45f;
    image.channels[1].pixels[0] = -0.0f;
    image.channels[2].pixels[0] = 1e30f;
    image.channels[5].pixels[0] = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < 16; ++i) {
        image.world_to_camera[i] = float(i);
        image.world_to_ndc[i] = float(i) * 0.5f;
    }
    image.screen_window_width = 0.75f;
    image.scene_text = "seed = 7\n";
    image.pixel_hash = pixel_hash(image);
    return image;
}

/// Bit for bit, so that -0 differs from 0.
inline bool same_bits(const Channel& a, const Channel& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.bytes()) == 0;
}

}  // namespace test
}  // namespace pileus
