// SPDX-License-Identifier: Apache-2.0
// Spheres and cameras for tests of the blender of billboards.
// in: few spheres seen by a small camera -> out: transmittance, colour and half depth.
// docs/methods.md 3, each image frame, step 5.
#pragma once
#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/display/blend.h"
#include "src/base/digest.h"
#include "src/methods/collectors/billboards/composite_billboards.h"

namespace blend_harness {

using namespace pileus;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <int W>
void blend(const BlendParams& p, const BlendBuffers& b, std::uint32_t begin, std::uint32_t end) {
    blend_tile<W>(p, b, begin, end);
}

/// Spheres by value; every channel of a sphere has its own colour.
struct Spheres {
    explicit Spheres(int channel_count = 1) : channels(channel_count) {}
    int channels;
    std::vector<float> x, y, z, radius, extinction, colour;  // colour [sphere][channel]

    void add(float cx, float cy, float cz, float r, float sigma, float c) {
        x.push_back(cx), y.push_back(cy), z.push_back(cz);
        radius.push_back(r), extinction.push_back(sigma);
        for (int k = 0; k < channels; ++k) colour.push_back(c * float(k + 1));
    }
    Status render(const CameraParams& camera, BillboardImage& out, const float* opaque = nullptr,
                  BlendFunction kernel = blend<4>, int threads = 1,
                  const BillboardTiling& tiling = {}) const {
        std::vector<float> planes(colour.size());
        for (std::size_t i = 0; i < x.size(); ++i)
            for (std::size_t k = 0; k < std::size_t(channels); ++k)
                planes[k * x.size() + i] = colour[i * std::size_t(channels) + k];
        const BillboardScene scene{x.data(),
                                   y.data(),
                                   z.data(),
                                   radius.data(),
                                   extinction.data(),
                                   planes.data(),
                                   std::uint32_t(x.size()),
                                   channels,
                                   opaque};
        return composite_billboards(scene, camera, threads, kernel, out, tiling);
    }
};

/// Looks along +y with z up; the image plane at distance 1 is 2 high (or `height` metres high).
inline CameraParams look_north(int width, int height) {
    CameraParams c{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0, 1, width, height, 0};
    c.half_width = float(width) / float(height);
    return c;
}
inline CameraParams look_flat(int width, int height, float half_height) {
    CameraParams c = look_north(width, height);
    c.orthographic = 1;
    c.half_width *= half_height;
    c.half_height = half_height;
    return c;
}

struct Pixel {
    double transmittance, colour, half_depth;
};

/// One pixel looking along +y.
inline Pixel through(const Spheres& spheres, float opaque = kInfinity,
                     const CameraParams& camera = look_north(1, 1)) {
    BillboardImage out;
    REQUIRE(bool(spheres.render(camera, out, &opaque)));
    return {out.transmittance[0], out.colour[0], out.half_depth[0]};
}

/// A random number in [low, high) of sphere i.
inline float number(std::uint32_t i, std::uint32_t draw, float low, float high) {
    return low + (high - low) * uniform(threefry(5u, 77u, i, draw).a);
}

/// Overlapping spheres around a place 60 m north; some beside, behind and around the camera.
inline Spheres many(std::uint32_t count, int channels) {
    Spheres s(channels);
    for (std::uint32_t i = 0; i < count; ++i)
        s.add(number(i, 0, -60, 60), number(i, 1, -5, 110), number(i, 2, -50, 50),
              number(i, 3, 0.5f, 12), number(i, 4, 0, 0.08f), number(i, 5, 0, 1));
    return s;
}

inline std::uint64_t digest(const BillboardImage& image) {
    Digest d;
    d.floats(image.transmittance.span());
    d.floats(image.colour.span());
    d.floats(image.half_depth.span());
    return d.value();
}

}  // namespace blend_harness
