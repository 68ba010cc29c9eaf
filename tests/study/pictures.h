// SPDX-License-Identifier: Apache-2.0
// Small pictures with known values for tests of comparisons.
// in: a size and a law of (channel, x, y) -> out: an Image.
// docs/testing.md, label study
#pragma once
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "kernels_cpu/core/rng.h"
#include "src/io/images/image.h"

namespace pileus {
namespace test {

/// Channels of the given names; `value(c, x, y)` with c their number.
template <class Value>
Image make_picture(int width, int height, const std::vector<std::string>& names, Value&& value) {
    Image image;
    image.width = width;
    image.height = height;
    for (std::size_t c = 0; c < names.size(); ++c) {
        image.channels.emplace_back();
        image.channels.back().name = names[c];
        REQUIRE(image.channels.back().pixels.resize(std::uint64_t(width) * std::uint64_t(height),
                                                    "test"));
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                image.channels.back().pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)] =
                    float(value(int(c), x, y));
    }
    return image;
}

/// R G B of one constant colour.
inline Image flat_picture(int width, int height, double r, double g, double b) {
    const double rgb[3] = {r, g, b};
    return make_picture(width, height, {"R", "G", "B"}, [&](int c, int, int) { return rgb[c]; });
}

/// A standard normal number of (seed, index), by Box and Muller.
inline double normal(std::uint32_t seed, std::uint32_t index) {
    const Words<std::uint32_t> bits = threefry<std::uint32_t>(seed, 77u, index, 5u);
    const double u = (bits.a + 0.5) / 4294967296.0, v = (bits.b + 0.5) / 4294967296.0;
    return std::sqrt(-2 * std::log(u)) * std::cos(6.283185307179586 * v);
}

}  // namespace test
}  // namespace pileus
