// SPDX-License-Identifier: Apache-2.0
// Laws of the filter of pictures: what its features say is kept, noise goes, light stays.
// in: made pictures -> out: their light after the filter. docs/filter.md.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "src/picture/filter/oidn.h"
#include "src/picture/filter/regression.h"
#include "tests/support/hashed_number.h"

using namespace pileus;
using pileus::test::number;

namespace {

/// A round cloud before the sky, thin at its rim, brighter on one side.
struct Rig {
    int width, height, threads = 1, radius = 0;
    std::vector<float> transmittance, depth, guides, opaque, light;

    Rig(int w, int h) : width(w), height(h) {
        const std::size_t n = std::size_t(w) * std::size_t(h);
        transmittance.resize(n), depth.resize(n), guides.resize(3 * n), light.resize(3 * n);
        for (std::size_t i = 0; i < n; ++i) {
            const float x = (float(i % std::size_t(w)) + 0.5f) / float(w) - 0.5f;
            const float y =
                (float(i / std::size_t(w)) + 0.5f) / float(w) - 0.5f * float(h) / float(w);
            const float inside = 0.16f - x * x - y * y;
            depth[i] = inside > 0 ? 60 * inside : 0;
            transmittance[i] = std::exp(-depth[i]);
            for (std::size_t g = 0; g < 3; ++g)
                guides[g * n + i] = (1 - transmittance[i]) * (0.5f + x) / float(g + 1);
        }
    }
    std::size_t pixels() const { return transmittance.size(); }
    /// Light that the features hold.
    float smooth(std::size_t channel, std::size_t i) const {
        return float(channel + 1) *
               (0.3f * (1 - transmittance[i]) + 0.5f * guides[i] + 0.02f * std::log(1 + depth[i]));
    }
    std::vector<float> filtered() const {
        std::vector<float> out = light;
        RegressionInput in;
        in.width = width, in.height = height, in.threads = threads, in.radius_pixels = radius;
        in.transmittance = transmittance.data();
        in.optical_depth = depth.data();
        in.guides = guides.data();
        in.opaque_depth = opaque.empty() ? nullptr : opaque.data();
        REQUIRE(filter_light(in, out.data()));
        return out;
    }
};

}  // namespace

TEST_CASE("filter: light that the features hold stays, with no rim brighter or darker") {
    Rig rig(160, 96);
    const std::size_t n = rig.pixels();
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < n; ++i) rig.light[c * n + i] = rig.smooth(c, i);
    for (const int radius : {0, 20, 400}) {
        CAPTURE(radius);
        rig.radius = radius;
        const std::vector<float> out = rig.filtered();
        // Ridges take a hundredth of what is there, at most, from any pixel.
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < n; ++i)
                CHECK(std::fabs(out[c * n + i] - rig.light[c * n + i]) <=
                      0.01f * float(c + 1) * (1.01f - rig.transmittance[i]));
    }
}

TEST_CASE("filter: noise goes, light as a whole stays, also where one sample is a thousand") {
    Rig rig(160, 96);
    const std::size_t n = rig.pixels();
    double before = 0, after = 0, sum = 0, kept = 0;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < n; ++i)
            rig.light[c * n + i] = number(c * n + i, 5) < 0.1f ? 10 * rig.smooth(c, i) : 0;
    const std::vector<float> out = rig.filtered();
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < n; ++i) {
            const double truth = double(rig.smooth(c, i));
            before +=
                (double(rig.light[c * n + i]) - truth) * (double(rig.light[c * n + i]) - truth);
            after += (double(out[c * n + i]) - truth) * (double(out[c * n + i]) - truth);
            sum += double(rig.light[c * n + i]);
            kept += double(out[c * n + i]);
        }
    // Some ten coefficients of 7700 pixels in a window are left of the noise.
    CHECK(after < 0.005 * before);
    CHECK(kept == doctest::Approx(sum).epsilon(0.02));
    // A single sample spreads, but nothing is thrown up elsewhere by more than it brought.
    std::fill(rig.light.begin(), rig.light.end(), 0.0f);
    const std::size_t rim = std::size_t(48 * 160 + 18);
    REQUIRE(rig.transmittance[rim] < 1);
    REQUIRE(rig.transmittance[rim] > 0.4f);
    rig.light[rim] = 1000;
    for (const float v : rig.filtered()) CHECK(std::fabs(v) <= 100);
}

TEST_CASE("filter: pixels without medium keep their bits, sky and solids are apart") {
    Rig rig(64, 40);
    const std::size_t n = rig.pixels();
    rig.opaque.assign(n, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < n; ++i) {
        if (i / 64 >= 20) rig.opaque[i] = 100;
        for (std::size_t c = 0; c < 3; ++c) rig.light[c * n + i] = rig.smooth(c, i);
    }
    const std::vector<float> alone = rig.filtered();
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < n; ++i) {
            if (rig.transmittance[i] == 1) CHECK(alone[c * n + i] == rig.light[c * n + i]);
            if (i / 64 >= 20) rig.light[c * n + i] = 1e4f * number(i, 3);
        }
    const std::vector<float> changed = rig.filtered();
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < 20 * 64; ++i) CHECK(changed[c * n + i] == alone[c * n + i]);
}

TEST_CASE("filter: any number of threads, pictures of any size, numbers of any size") {
    Rig rig(61, 37);
    for (std::size_t i = 0; i < rig.light.size(); ++i) rig.light[i] = number(i, 8);
    const std::vector<float> one = rig.filtered();
    for (const int threads : {2, 3}) {
        rig.threads = threads;
        CHECK(rig.filtered() == one);
    }
    for (const auto& size : {std::pair{1, 1}, {1, 50}, {50, 1}, {8, 8}, {9, 17}}) {
        Rig small(size.first, size.second);
        for (const float scale : {0.0f, 1e-30f, 1.0f, 1e15f}) {
            CAPTURE(scale);
            for (std::size_t i = 0; i < small.light.size(); ++i)
                small.light[i] = scale * number(i, 2);
            for (const float v : small.filtered()) CHECK(std::isfinite(v));
        }
    }
}

TEST_CASE(
    "filter: a ground seen through media, its shadow stays, coins go, the sky keeps its bits") {
    Rig rig(128, 96);
    const std::size_t n = rig.pixels(), sky = std::size_t(128 * 24);
    rig.opaque.assign(n, std::numeric_limits<float>::infinity());
    std::vector<float> sun(n), truth(3 * n), light(3 * n);
    for (std::size_t i = 0; i < n; ++i) {
        rig.transmittance[i] = 1 - 0.7f * (1 - rig.transmittance[i]);
        sun[i] = i / 128 < 70 ? 1.0f : 0.1f;  // a shadow with an edge; no sun at all in a corner
        if (i % 128 < 8) sun[i] = 0;
        if (i >= sky) rig.opaque[i] = 100;
        for (std::size_t c = 0; c < 3; ++c) {
            const float ground = float(c + 1) * (0.2f + 0.6f * sun[i] + 0.001f * float(i % 128));
            truth[c * n + i] = rig.transmittance[i] * ground;
            // A path gets there or it does not; sky is none of this filter's.
            const bool through = number(c * n + i, 6) < rig.transmittance[i];
            light[c * n + i] = i < sky ? number(i, 7) : through ? ground : 0;
        }
    }
    RegressionInput in;
    in.width = 128, in.height = 96;
    in.transmittance = rig.transmittance.data();
    in.opaque_depth = rig.opaque.data();
    in.sun_on_ground = sun.data();
    std::vector<float> out[2] = {light, light};
    for (const int threads : {1, 3}) {
        in.threads = threads;
        REQUIRE(filter_ground(in, out[threads / 2].data()));
    }
    CHECK(out[0] == out[1]);
    double before = 0, after = 0;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t at = c * n + i;
            if (i < sky) {
                CHECK(out[0][at] == light[at]);
                continue;
            }
            before +=
                (double(light[at]) - double(truth[at])) * (double(light[at]) - double(truth[at]));
            after +=
                (double(out[0][at]) - double(truth[at])) * (double(out[0][at]) - double(truth[at]));
            // A shadow edge of 0.54 a channel would show, were it blurred.
            CHECK(std::fabs(out[0][at] - truth[at]) < 0.1f * float(c + 1));
        }
    CHECK(after < 0.02 * before);
}

TEST_CASE("filter: Open Image Denoise, where it is, takes noise and leaves light in its channel") {
    if (const Status status = check_oidn("s.toml: filter.kind: "); !status) {
        CHECK(status.code == Code::kBadInput);
        CHECK(status.message.find("s.toml: filter.kind: ") == 0);
        CHECK(status.message.find("allowed: ") != std::string::npos);
        CHECK(status.message.find('\n') == std::string::npos);
        return;
    }
    const std::size_t width = 64, n = width * 48;
    std::vector<float> light(3 * n);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < n; ++i)
            light[c * n + i] = float(c + 1) * (0.5f + number(c * n + i, 4));
    REQUIRE(denoise_by_oidn("", int(width), 48, 2, light.data()));
    for (std::size_t c = 0; c < 3; ++c) {
        double mean = 0, square = 0;
        for (std::size_t i = 0; i < n; ++i) mean += double(light[c * n + i]) / double(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double v = double(light[c * n + i]) - mean;
            square += v * v / double(n);
        }
        // Even noise from 0.5 to 1.5 has a variance of 1/12; a network keeps a few percent of it.
        CHECK(mean == doctest::Approx(double(c + 1)).epsilon(0.05));
        CHECK(square < 0.2 / 12 * double((c + 1) * (c + 1)));
    }
}
