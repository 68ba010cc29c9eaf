// SPDX-License-Identifier: Apache-2.0
// Media that emit: slabs in closed form by every method, the isothermal furnace, orders, layers.
// in: small scenes -> out: pass or fail.
// docs/lights.md, "Media that emit". Paths: 4 standard errors of a sum over all pixels.
#include <cmath>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

constexpr const char* kMarched[] = {"raymarch", "optical-depth", "collectors", "photon-grid"};

/// From the front, in parallel: each ray crosses the whole box.
constexpr const char* kFront = R"(
[camera]
position_m = [0, -300, 50]
target_m = [0, 0, 50]
projection = "orthographic"
height_m = 40
resolution = [8, 6]
[path]
samples_per_pixel = 2000
[output]
layers = ["radiance", "alpha", "error", "cloud", "order"]
)";

constexpr const char* kSlab = R"(
[[medium]]
density = "uniform:box"
bounds_m = [[-50, -50, 0], [50, 50, 100]]
resolution = [16, 16, 16]
extinction_per_m = 0.02
albedo = 0
emission = [0.04, 0.02, 0.002]
)";

/// Both of its media keep the balance with a sky of [1, 0.5, 0.25]: emission / extinction is
/// (1 - albedo) times that.
constexpr const char* kFurnace = R"(
[sky]
radiance = [1, 0.5, 0.25]
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-60, -60, 0], [60, 60, 100]]
resolution = [24, 24, 20]
extinction_per_m = 0.0625
albedo = [0.5, 0.75, 1]
emission = [0.03125, 0.0078125, 0]
phase = { type = "henyey-greenstein", g = 0.5 }
[[medium]]
density = "uniform:box"
bounds_m = [[-60, -60, 0], [60, 60, 50]]
resolution = [24, 24, 10]
extinction_per_m = 0.015625
albedo = 0.25
emission = [0.01171875, 0.005859375, 0.0029296875]
)";

/// Without the layers that a method does not have.
Picture by(const std::string& method, const std::string& text,
           const std::vector<std::string>& overrides = {}) {
    std::vector<std::string> all = overrides;
    all.push_back("method.name = \"" + method + "\"");
    Scene scene = scene_from(text, all);
    const bool marches = method == "raymarch" || method == "optical-depth";
    if (marches) scene.output.layer_error = scene.output.layer_order = false;
    return render_one(scene);
}

}  // namespace

TEST_CASE("emission: an absorbing slab shows emission / extinction (1 - e^-tau)") {
    const std::string text = std::string(kFront) + kSlab;
    const double seen = 1 - std::exp(-0.02 * 100);
    const double exact[3] = {2 * seen, seen, 0.1 * seen};
    const char* const channels[3] = {"R", "G", "B"};
    const Picture path = by("path", text);
    for (int c = 0; c < 3; ++c) {
        CAPTURE(c);
        const PixelSum sum = sum_of(path, channels[c]);
        CHECK(sum.error < 0.01 * sum.value);
        CHECK(std::fabs(sum.value - 48 * exact[c]) < 4 * sum.error);
        for (const char* method : kMarched) {
            const Picture marched = by(method, text);
            // Steps are exact in a homogeneous medium: roundings of some hundred of them are left.
            for (int x = 0; x < 8; ++x)
                CHECK(double(marched.at(channels[c], x, x % 6)) ==
                      doctest::Approx(exact[c]).epsilon(2e-5));
        }
    }
    // It is the media's own light, and scattered by nothing.
    for (const char* method : {"path", "collectors", "photon-grid"}) {
        const Picture p = by(method, text);
        for (int x = 0; x < 8; ++x) {
            CHECK(p.at("cloud.R", x, 2) == p.at("R", x, 2));
            CHECK(p.at("multiple.R", x, 2) == p.at("R", x, 2));
            CHECK(p.at("single.R", x, 2) == 0.0f);
        }
    }
}

TEST_CASE("emission: a slab without end, seen at a slant") {
    const std::string text = std::string(kFront) + kSlab;
    const std::vector<std::string> slant = {
        "medium.0.boundary = \"periodic\"", "camera.position_m = [0, -300, 400]",
        "camera.target_m = [0, 0, 100]", "output.layers = [\"radiance\", \"alpha\", \"error\"]"};
    const double exact = 2 * (1 - std::exp(-0.02 * 100 * std::sqrt(2.0)));
    const PixelSum sum = sum_of(by("path", text, slant), "R");
    CHECK(std::fabs(sum.value - 48 * exact) < 4 * sum.error);
    for (const char* method : kMarched) {
        CAPTURE(std::string(method));
        // As above; the ray's direction is in floats.
        CHECK(double(by(method, text, slant).at("R", 3, 3)) ==
              doctest::Approx(exact).epsilon(2e-5));
    }
}

TEST_CASE("emission: two media in balance with the sky are not to be seen") {
    const Picture path = by("path", std::string(kFront) + kFurnace);
    const double sky[3] = {1, 0.5, 0.25};
    const char* const channels[3] = {"R", "G", "B"};
    double widest = 0;
    for (int c = 0; c < 3; ++c) {
        CAPTURE(c);
        const PixelSum sum = sum_of(path, channels[c]);
        CHECK(std::fabs(sum.value - 48 * sky[c]) < 4 * sum.error);
        widest = sum.error / sum.value > widest ? sum.error / sum.value : widest;
    }
    // Without emission a tenth of the light at least would be missing.
    CHECK(widest < 0.01);
    const Picture dark = by("path", std::string(kFront) + kFurnace,
                            {"medium.0.emission = 0", "medium.1.emission = 0"});
    CHECK(sum_of(dark, "R").value < 0.9 * 48);
}

TEST_CASE("emission: marched in uneven media of two kinds as by paths") {
    // Spread over pixels, paths are 1.5 % brighter here.
    const std::vector<std::string> alone = {"sky.radiance = 0", "medium.0.albedo = 0",
                                            "medium.1.albedo = 0", "path.pixel = \"centre\""};
    const std::string text = std::string(kFront) + kFurnace;
    const PixelSum path = sum_of(by("path", text, alone), "R");
    CHECK(path.error < 0.005 * path.value);
    for (const char* method : {"raymarch", "collectors", "photon-grid"}) {
        CAPTURE(std::string(method));
        const PixelSum marched = sum_of(by(method, text, alone), "R");
        // Steps as long as cells: 0.03 % by 40 000 samples.
        CHECK(std::fabs(marched.value - path.value) < 4 * path.error + 0.001 * path.value);
    }
}

TEST_CASE("emission: the last flight of a path finds it under a black sky") {
    const std::string text = std::string(kFront) + kFurnace;
    const std::vector<std::string> black = {"path.max_depth = 1", "sky.radiance = 0",
                                            "path.samples_per_pixel = 50"};
    std::vector<std::string> faint = black;
    faint[1] = "sky.radiance = 1e-30";
    const Picture a = by("path", text, black), b = by("path", text, faint);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) CHECK(std::fabs(a.at("G", x, y) - b.at("G", x, y)) <= 1e-30f);
    CHECK(sum_of(a, "G").value > 0);
}

TEST_CASE("emission: what keeps its own light on thick nodes is warned of, and nothing else") {
    const std::string text = std::string(kFront) + kSlab;
    const auto warnings = [&](const char* extinction, const char* albedo, const char* emission) {
        return by("raymarch", text,
                  {"output.layers = [\"radiance\"]", "medium.0.resolution = [48, 48, 48]",
                   std::string("medium.0.extinction_per_m = ") + extinction,
                   std::string("medium.0.albedo = ") + albedo,
                   std::string("medium.0.emission = ") + emission})
            .report.warnings;
    };
    const std::vector<std::string> told = warnings("1", "1", "0.01");
    REQUIRE(told.size() == 1);
    CHECK(told[0].find("it may be darker by a half") != std::string::npos);
    CHECK(warnings("1", "[0.5, 0.9, 0]", "0.01").empty());
    CHECK(warnings("1", "1", "0").empty());
    CHECK(warnings("0.1", "1", "0.01").empty());
}
