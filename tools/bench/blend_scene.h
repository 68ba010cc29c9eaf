// SPDX-License-Identifier: Apache-2.0
// Made-up billboards in front of a camera: what the blender's figures are measured on.
// in: a count, the picture's size, the share of it that the centres cover -> out: spheres.
// docs: README.md in this folder.
#pragma once
#include <cmath>
#include <vector>

#include "kernels_cpu/core/rng.h"
#include "src/methods/collectors/billboards/composite_billboards.h"

namespace bench {

/// Spheres with diameters even between 32 and 96 pixels (64 on average), between 1 and 3 km away,
/// whose middles take 0.5 to 1.5 optical depths.
struct BlendSpheres {
    pileus::CameraParams camera{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0, 0, 0, 0, 0};
    std::vector<float> x, y, z, radius, extinction, colour;

    pileus::BillboardScene scene() const {
        pileus::BillboardScene s;
        s.x = x.data(), s.y = y.data(), s.z = z.data();
        s.radius = radius.data(), s.extinction = extinction.data(), s.colour = colour.data();
        s.count = std::uint32_t(x.size());
        s.half_depth = false;
        return s;
    }
};

/// `share` of the picture, in its middle, holds the centres: 1 or less.
inline BlendSpheres make_blend_spheres(std::size_t count, int width, int height, double share) {
    BlendSpheres s;
    s.camera.width = width, s.camera.height = height;
    s.camera.half_height = 0.4f;
    s.camera.half_width = s.camera.half_height * float(width) / float(height);
    const double side = std::sqrt(share), pixel = 2.0 * double(s.camera.half_height) / height;
    for (std::size_t i = 0; i < count; ++i) {
        const auto number = [i](std::uint32_t draw) {
            return double(pileus::uniform(pileus::threefry(5u, 77u, std::uint32_t(i), draw).a));
        };
        const double away = 1000 + 2000 * number(2), diameter = 32 + 64 * number(3);
        const double radius = diameter / 2 * away * pixel;
        s.x.push_back(float((2 * number(0) - 1) * side * double(s.camera.half_width) * away));
        s.y.push_back(float(away));
        s.z.push_back(float((2 * number(1) - 1) * side * double(s.camera.half_height) * away));
        s.radius.push_back(float(radius));
        s.extinction.push_back(float((0.5 + number(4)) / (2 * radius)));
    }
    for (std::uint32_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < count; ++i)
            s.colour.push_back(pileus::uniform(pileus::threefry(5u, 78u, std::uint32_t(i), k).a));
    return s;
}

}  // namespace bench
