// SPDX-License-Identifier: Apache-2.0
// Many thin layers, nothing and everything opaque, and what half floats and 8 bits would lose.
// in: spheres along one ray, pictures of extreme numbers -> out: the closed form, the same bits.
// docs/testing.md S67-S69, S71: layers are blended in floats, bytes are made once, at the end.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <vector>

#include "kernels_cpu/isa/kernels.h"
#include "src/io/images/image_file.h"
#include "src/methods/collectors/billboards/composite_billboards.h"
#include "tests/io/temp_folder.h"

using namespace pileus;

namespace {

/// Spheres of radius 1 in a row along +y, each of optical depth `depth` and its own colour.
struct Row {
    std::vector<float> x, y, z, radius, extinction, colour;

    void add(float at, float depth, float light) {
        x.push_back(0), y.push_back(at), z.push_back(0), radius.push_back(1);
        extinction.push_back(depth / 2), colour.push_back(light);
    }
    struct Pixel {
        double transmittance, colour;
    };
    Pixel look() const {
        const BillboardScene scene{x.data(),
                                   y.data(),
                                   z.data(),
                                   radius.data(),
                                   extinction.data(),
                                   colour.data(),
                                   std::uint32_t(x.size()),
                                   1,
                                   nullptr};
        const CameraParams camera{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1e-3f,
                                  1e-3f,     1,         1,         0};
        BillboardImage out;
        REQUIRE(composite_billboards(scene, camera, 1, kernel_table(nullptr)->blend_tile, out, {}));
        return {double(out.transmittance[0]), double(out.colour[0])};
    }
};

}  // namespace

TEST_CASE("S67, S68: 100 000 layers of any thinness, and the byte they make") {
    for (double depth : {1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2}) {
        Row row;
        for (int i = 0; i < 100'000; ++i) row.add(float(2 + 2 * i), float(depth), 1);
        const Row::Pixel p = row.look();
        const double alpha = -std::expm1(-1e5 * depth);
        std::printf("1e5 layers of %g: alpha %.7g ref %.7g, colour %.7g\n", depth,
                    1 - p.transmittance, alpha, p.colour);
        // Blending stops at 1e-4. Transmittance is one float: every layer may round it by half an
        // ulp, 2^-25, which 1e5 layers of one kind add up to 3e-3.
        constexpr double kBound = 1e-4 + 1e5 * 0x1p-25;
        CHECK(std::fabs(p.colour - alpha) <= kBound);
        CHECK(std::fabs(1 - p.transmittance - alpha) <= kBound);
        // In a frame buffer of 8 bits such layers would vanish; ours errs by one code at most.
        CHECK(std::fabs(std::floor(255 * p.colour + 0.5) - std::floor(255 * alpha + 0.5)) <= 1);
    }
}

TEST_CASE("S69: from the front or from the back, the sum of the layers is one") {
    // A generator of its own, so that the rows differ: x -> 5^13 x mod 2^31.
    std::uint64_t state = 1;
    const auto draw = [&] {
        return double(state = state * 1220703125u % 2147483648u) / 2147483648;
    };
    double worst = 0;
    for (int trial = 0; trial < 200; ++trial) {
        Row row;
        std::vector<double> alpha, light;
        for (int i = 0; i < 40; ++i) {
            // Among others layers of alpha 0 and of alpha 1.
            const double depth = i % 13 == 5 ? 0.0 : trial % 4 == 3 && i == 30 ? 1e5 : 0.3 * draw();
            const double c = draw();
            row.add(float(2 + 2 * i), float(depth), float(c));
            alpha.push_back(-std::expm1(-double(float(depth) / 2) * 2));
            light.push_back(double(float(c)));
        }
        double back = 0, through = 1;
        for (std::size_t i = alpha.size(); i-- > 0;) {
            back = alpha[i] * light[i] + (1 - alpha[i]) * back;
            through *= 1 - alpha[i];
        }
        const Row::Pixel p = row.look();
        worst = std::max(worst, std::fabs(p.colour - back));
        worst = std::max(worst, std::fabs(p.transmittance - through));
    }
    std::printf("front to back against back to front: worst %.2g\n", worst);
    // The blender leaves out what lies behind 1e-4 of the light.
    CHECK(worst <= 1e-4);

    Row clear, wall;
    clear.add(5, 0, 7);
    CHECK(clear.look().transmittance == 1);
    CHECK(clear.look().colour == 0);
    wall.add(5, 1e30f, 7);
    wall.add(50, 1e30f, 1000);
    CHECK(wall.look().transmittance == 0);
    CHECK(wall.look().colour == 7);
}

TEST_CASE("S71: radiances beyond what half floats hold keep every bit in a file") {
    const test::TempFolder folder;
    const float values[] = {65504.0f, 65519.99f, 65520.0f, 1e30f,  6e-8f, 1e-45f,
                            1e-12f,   1e9f,      3.4e38f,  0.333f, 0.0f,  2049.0f};
    for (const char* name : {"a.exr", "a.pfm"}) {
        if (!can_write_image(folder.path(name))) continue;  // left out of this build
        Image image;
        image.width = 4, image.height = 1;
        for (const char* channel : {"R", "G", "B"}) {
            image.channels.emplace_back();
            image.channels.back().name = channel;
            REQUIRE(image.channels.back().pixels.resize(4, "test"));
            for (std::size_t i = 0; i < 4; ++i)
                image.channels.back().pixels[i] = values[4 * (image.channels.size() - 1) + i];
        }
        REQUIRE(write_image(image, folder.path(name), ToneSettings{}));
        Image back;
        REQUIRE(read_image(folder.path(name), back));
        for (const char* channel : {"R", "G", "B"}) {
            const Channel *a = image.find(channel), *b = back.find(channel);
            REQUIRE(b != nullptr);
            CHECK(std::memcmp(a->pixels.data(), b->pixels.data(), 16) == 0);
        }
    }
}
