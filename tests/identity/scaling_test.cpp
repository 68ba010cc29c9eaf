// SPDX-License-Identifier: Apache-2.0
// Powers of two in the light and in the lengths leave every other bit of a picture alone.
// in: small scenes, scaled -> out: equal pixels, after the same factor.
// Scaling by 2^k is exact in binary arithmetic as long as nothing over- or underflows.
#include <array>
#include <cmath>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

std::vector<std::string> with(const std::string& display, const std::string& variant) {
    return {"collectors.display=\"" + display + "\"", "collectors.variant=\"" + variant + "\""};
}

/// Every pixel of `b` is the one of `a` times the factor of its channel.
void check_scaled(const Picture& a, const Picture& b, float light, float depth) {
    REQUIRE(a.image.channels.size() == b.image.channels.size());
    std::size_t different = 0;
    for (std::size_t c = 0; c < a.image.channels.size(); ++c) {
        const Channel &x = a.image.channels[c], &y = b.image.channels[c];
        const float factor = x.name == "A" ? 1.0f : x.name == "Z" ? depth : light;
        for (std::size_t i = 0; i < x.pixels.size(); ++i)
            different += x.pixels[i] * factor != y.pixels[i];
    }
    CHECK(different == 0);
}

void scale_light(Scene& scene, float factor) {
    for (float& v : scene.sun.irradiance) v *= factor;
    for (float& v : scene.sky.radiance) v *= factor;
}

void scale_lengths(Scene& scene, double factor) {
    for (Double3* v : {&scene.camera.position_m, &scene.camera.target_m,
                       &scene.media[0].box.bounds_m[0], &scene.media[0].box.bounds_m[1]})
        *v *= factor;
    scene.camera.height_m *= factor;
    scene.ground.altitude_m *= factor;
    scene.media[0].optics.extinction_per_m /= factor;
}

const std::array<const char*, 2> kLooks[] = {
    {"march", "best"}, {"billboards", "best"}, {"billboards", "paper"}};

}  // namespace

TEST_CASE("scaling: light times 2^k is the picture times 2^k") {
    for (const auto& look : kLooks) {
        const Scene scene = scene_from(kSmallCumulus, with(look[0], look[1]));
        const Picture plain = render_one(scene);
        for (int k : {-20, 3, 20}) {
            CAPTURE(look[0]);
            CAPTURE(k);
            Scene scaled = scene;
            scale_light(scaled, float(std::ldexp(1.0, k)));
            check_scaled(plain, render_one(scaled), float(std::ldexp(1.0, k)), 1);
        }
    }
}

TEST_CASE("scaling: lengths times 2^k with extinction over 2^k is the same picture") {
    for (const auto& look : kLooks) {
        const Scene scene = scene_from(kSmallCumulus, with(look[0], look[1]));
        const Picture plain = render_one(scene);
        for (int k : {-10, 1, 6}) {
            CAPTURE(look[0]);
            CAPTURE(look[1]);
            CAPTURE(k);
            Scene scaled = scene;
            scale_lengths(scaled, std::ldexp(1.0, k));
            check_scaled(plain, render_one(scaled), 1, float(std::ldexp(1.0, k)));
        }
    }
}

TEST_CASE("scaling: threads and instruction sets give one picture") {
    for (const auto& look : kLooks) {
        const Scene scene = scene_from(kSmallCumulus, with(look[0], look[1]));
        RenderOptions options;
        options.threads = 1;
        const std::string hash = render_one(scene, options).report.hash;
        for (int threads : {2, 3, 8}) {
            options.threads = threads;
            CHECK(render_one(scene, options).report.hash == hash);
        }
        for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i) {
            options.isa = table->name;
            CHECK(render_one(scene, options).report.hash == hash);
        }
        Scene other = scene;
        other.seed = 5;
        CHECK(render_one(other, options).report.hash != hash);
    }
}
