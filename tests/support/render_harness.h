// SPDX-License-Identifier: Apache-2.0
// Renders small scenes written in a test, and reads pixels.
// in: TOML -> out: an image and its report.
// docs/scene.md.
#pragma once
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "kernels_cpu/isa/kernels.h"
#include "src/scene/read_scene.h"
#include "src/session/render.h"

namespace render_test {

using namespace pileus;

struct Picture {
    Image image;
    Report report;

    float at(const char* channel, int x, int y) const {
        const Channel* c = image.find(channel);
        REQUIRE(c != nullptr);
        return c->pixels[std::size_t(y) * std::size_t(image.width) + std::size_t(x)];
    }
    std::uint64_t counter(const char* name) const {
        for (const auto& c : report.counters)
            if (c.first == name) return c.second;
        FAIL("no counter of this name");
        return 0;
    }
};

/// A coloured cumulus of 24 x 24 x 16 voxels over a ground; all its numbers are exact in binary.
constexpr const char* kSmallCumulus = R"(
seed = 4
[camera]
position_m = [16, -4000, 256]
target_m = [0, 0, 1024]
fov_deg = 40
resolution = [24, 14]
[sun]
azimuth_deg = 120
elevation_deg = 35
[sky]
radiance = [0.0625, 0.125, 0.25]
[ground]
altitude_m = 0
albedo = 0.25
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-768, -768, 512], [768, 768, 1536]]
resolution = [24, 24, 16]
extinction_per_m = 0.0125
albedo = [0.9, 0.99, 1.0]
phase = { type = "henyey-greenstein", g = 0.85 }
[photon_grid]
photons = 12_000
generations = 4
[collectors]
photons = 12_000
generations = 4
samples = 1_000
[output]
layers = ["radiance", "alpha", "depth", "error"]
)";

inline Scene scene_from(const std::string& text, const std::vector<std::string>& overrides = {}) {
    Scene scene;
    const Status status = read_scene_text(text, "test.toml", "", overrides, scene);
    REQUIRE_MESSAGE(status, status.message);
    return scene;
}

inline Picture render_one(const Scene& scene, const RenderOptions& options = {}) {
    Picture picture;
    const Status status = render(scene, options, [&](int, Image& image, Report& report) {
        picture.image = std::move(image);
        picture.report = report;
        return Status::ok();
    });
    REQUIRE_MESSAGE(status, status.message);
    CHECK(picture.counter("nan") == 0);
    CHECK(picture.counter("majorant_violations") == 0);
    for (const EnergyRow& row : picture.report.photons.energy) CHECK(row.balance_quanta == 0);
    return picture;
}

/// R, G, B and A of every pixel, row by row.
inline std::vector<float> pixels_of(const Picture& p) {
    std::vector<float> values;
    for (int row = 0; row < p.image.height; ++row)
        for (int column = 0; column < p.image.width; ++column)
            for (const char* channel : {"R", "G", "B", "A"})
                values.push_back(p.at(channel, column, row));
    return values;
}

/// Sum of a channel over all pixels, and its standard error where the picture has one.
struct PixelSum {
    double value = 0, error = 0;
};
inline PixelSum sum_of(const Picture& p, const std::string& channel) {
    PixelSum s;
    const std::string error = "error." + channel;
    const bool noisy = p.image.find(error.c_str()) != nullptr;
    for (int y = 0; y < p.image.height; ++y)
        for (int x = 0; x < p.image.width; ++x) {
            s.value += double(p.at(channel.c_str(), x, y));
            if (noisy) s.error += std::pow(double(p.at(error.c_str(), x, y)), 2);
        }
    s.error = std::sqrt(s.error);
    return s;
}

}  // namespace render_test
