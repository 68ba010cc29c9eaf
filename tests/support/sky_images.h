// SPDX-License-Identifier: Apache-2.0
// Small skies for tests, and the plain double arithmetic of what they send.
// in: a size and a function of texel and channel -> out: pictures; brute-force integrals.
// docs/methods.md 3 "Sky map": bilinear between texel centres, outermost rows up to the poles.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "src/base/angles.h"
#include "src/world/light/sky_map.h"

namespace sky_test {

using namespace pileus;

template <class Value>
Image sky_image(int width, int height, Value value) {
    Image image;
    image.width = width;
    image.height = height;
    for (int c = 0; c < 3; ++c) {
        image.channels.emplace_back();
        image.channels.back().name = std::string(1, "RGB"[c]);
        REQUIRE(image.channels.back().pixels.resize(std::uint64_t(width) * std::uint64_t(height),
                                                    "sky"));
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column)
                image.channels.back().pixels[std::size_t(row * width + column)] =
                    float(value(row, column, c));
    }
    return image;
}

/// A sky with texels of every brightness and colour, some black, and one row black throughout.
inline Image rough_sky(int width, int height, bool coloured) {
    return sky_image(width, height, [&](int row, int column, int c) {
        if ((row * 7 + column * 3) % 5 == 0 || row == 1) return 0.0;
        const int k = (row * 31 + column * 17 + (coloured ? c * 5 : 0)) % 23;
        return 0.05 * k * k / 4 + 0.1;
    });
}

inline SkyMap sky_map_of(const Image& image, bool ground, const double (&extent_m)[3],
                         double rotation_deg = 0, double scale = 1, bool periodic = false) {
    SkyMap map;
    Sky sky;
    sky.map_scale = scale;
    sky.map_rotation_deg = rotation_deg;
    REQUIRE(make_sky_map("sky", image, sky, ground, map));
    REQUIRE(aim_sky_map(extent_m, periodic, map));
    return map;
}

/// Radiance of one channel towards angle `theta` from the zenith and azimuth `phi`, radians.
inline double radiance_at(const SkyMap& map, double theta, double phi, int channel) {
    const SkyMapView& v = map.view;
    const double p = std::min(std::max(theta / kPi64 * map.size[1] - 0.5, 0.0), v.rows - 1.0);
    const double turn = phi / (2 * kPi64) - map.rotation_deg / 360 + 0.5;
    const double q = (turn - std::floor(turn)) * v.columns - 0.5;
    const int row = int(p), column = int(std::floor(q));
    const auto texel = [&](int r, int c) {
        const int x = ((c % v.columns) + v.columns) % v.columns, y = std::min(r, v.rows - 1);
        const int plane = v.planes == 1 ? 0 : channel;
        return double(v.radiance[(plane * v.rows + y) * v.columns + x]);
    };
    const double f = q - column, g = p - row;
    return (texel(row, column) * (1 - f) + texel(row, column + 1) * f) * (1 - g) +
           (texel(row + 1, column) * (1 - f) + texel(row + 1, column + 1) * f) * g;
}

/// Calls use(theta, phi, solid angle) for a fine grid of directions over the part that shines.
template <class Use>
void each_direction(bool ground, Use use) {
    constexpr int kRows = 720, kColumns = 1440;
    for (int i = 0; i < (ground ? kRows / 2 : kRows); ++i)
        for (int j = 0; j < kColumns; ++j) {
            const double theta = (i + 0.5) * kPi64 / kRows;
            const double phi = (j + 0.5) * 2 * kPi64 / kColumns;
            use(theta, phi, std::sin(theta) * (kPi64 / kRows) * (2 * kPi64 / kColumns));
        }
}

/// What a box with edges `e` shows to a direction.
inline double silhouette(const double (&e)[3], double theta, double phi) {
    return std::fabs(std::sin(theta) * std::sin(phi)) * e[1] * e[2] +
           std::fabs(std::sin(theta) * std::cos(phi)) * e[2] * e[0] +
           std::fabs(std::cos(theta)) * e[0] * e[1];
}

}  // namespace sky_test
