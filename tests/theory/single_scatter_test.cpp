// SPDX-License-Identifier: Apache-2.0
// Thin clouds in sunlight: radiance is irradiance x albedo x phase function x optical depth.
// in: boxes and spheres of optical depth 4e-3, both displays -> out: ratios to the closed form.
// docs/methods.md 3, repair 3: the first order keeps the exact phase function.
#include <cmath>
#include <cstdio>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

constexpr double kPiExact = 3.14159265358979323846;

// The camera looks north; a pixel is 5 m wide.
const char* const kText = R"(
seed = 3
[camera]
position_m = [0, -1000, 0]
target_m = [0, 0, 0]
projection = "orthographic"
height_m = 240
resolution = [48, 48]
[sun]
azimuth_deg = 90
elevation_deg = 0
irradiance = [2, 1, 0.5]
[[medium]]
density = "uniform:sphere"
bounds_m = [[-100, -100, -100], [100, 100, 100]]
resolution = [40, 40, 40]
extinction_per_m = 2e-5
albedo = 0.8
phase = { type = "henyey-greenstein", g = 0.85 }
[collectors]
photons = 4_000_000
generations = 4
samples = 500
)";

double hg(double g, double cosine) {
    return (1 - g * g) / (4 * kPiExact * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// Cosine between the sun's light and the way to a camera in the south.
double cosine_of(double azimuth_deg) {
    // Light travels against (sin az, cos az); the way to the camera is (0, -1).
    return std::cos(azimuth_deg * kPiExact / 180);
}

struct Case {
    double g, azimuth_deg;
};
const Case kCases[] = {{0, 90}, {0.85, 90}, {0.85, 30}, {0.85, 180}, {-0.5, 120}};

std::vector<std::string> overrides_of(const Case& c) {
    return {"medium.0.phase={type=\"henyey-greenstein\", g=" + std::to_string(c.g) + "}",
            "sun.azimuth_deg=" + std::to_string(c.azimuth_deg)};
}

/// Second order and shadow: an optical depth of at most 4e-3, times the ratio of mean to single
/// scattering, 1/(4 pi p), where the lobe looks away.
double second_order(const Case& c) {
    return 4e-3 * std::max(1.0, 1 / (4 * kPiExact * hg(c.g, cosine_of(c.azimuth_deg))));
}

struct Sums {
    double green = 0, alpha = 0;
};
Sums add_pixels(const Picture& p) {
    Sums s;
    for (int y = 0; y < p.image.height; ++y)
        for (int x = 0; x < p.image.width; ++x) {
            s.green += double(p.at("G", x, y));
            s.alpha += double(p.at("A", x, y));
        }
    return s;
}

}  // namespace

TEST_CASE("single scattering: marched sunlight, pixel by pixel") {
    for (const Case& c : kCases)
        for (const char* shape : {"uniform:sphere", "uniform:box"}) {
            auto overrides = overrides_of(c);
            overrides.push_back(std::string("medium.0.density=\"") + shape + "\"");
            RenderOptions no_photons;  // the first order alone is marched without any
            no_photons.budget.photons = 0;
            const Picture p = render_one(scene_from(kText, overrides), no_photons);
            const double source = 0.8 * hg(c.g, cosine_of(c.azimuth_deg));
            const char* const names[3] = {"R", "G", "B"};
            const double irradiance[3] = {2, 1, 0.5};
            double worst = 0;
            int seen = 0;
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 48; ++x) {
                    const double alpha = double(p.at("A", x, y));
                    if (alpha < 1e-4) continue;
                    ++seen;
                    for (std::size_t ch = 0; ch < 3; ++ch) {
                        const double r = double(p.at(names[ch], x, y));
                        worst =
                            std::max(worst, std::fabs(r / (irradiance[ch] * source * alpha) - 1));
                    }
                }
            std::printf("march %s g %g sun at %g: worst pixel off by %.2g\n", shape, c.g,
                        c.azimuth_deg, worst);
            CHECK(seen > 1000);
            // The shadow takes off at most the optical depth, 4e-3; an opacity of 1e-4 is known
            // to half a unit of 1 in float, 6e-8, or 6e-4 of it.
            CHECK(worst <= 4.6e-3);
            // Through the middle the path is 200 m, to within the surface's blur of a voxel.
            CHECK(double(p.at("A", 24, 24)) == doctest::Approx(4e-3).epsilon(0.01));
        }
}

TEST_CASE("single scattering: whole pictures with photons, both displays") {
    const double volume = 4.0 / 3.0 * kPiExact * 1e6;
    for (const char* display : {"march", "billboards"})
        for (const Case& c : kCases) {
            auto overrides = overrides_of(c);
            overrides.push_back(std::string("collectors.display=\"") + display + "\"");
            // Pixels of 1 m: billboards and voxels lie on one lattice, which coarse pixels beat
            // with.
            overrides.push_back("camera.resolution=[240, 240]");
            overrides.push_back("collectors.photons=12000000");
            const Picture p = render_one(scene_from(kText, overrides));
            const Sums sums = add_pixels(p);
            const double opacity = sums.alpha / (2e-5 * volume);
            const double ratio =
                sums.green / (0.8 * hg(c.g, cosine_of(c.azimuth_deg)) * 2e-5 * volume);
            const double error = 1 / std::sqrt(double(p.report.events.scatterings));
            std::printf("%s g %g sun at %g: light %.4f se %.4f opacity %.4f\n", display, c.g,
                        c.azimuth_deg, ratio, error, opacity);
            // 1 - exp(-tau) takes off at most half the optical depth; the sphere's own volume on
            // the grid is true to 0.2 %, the pixels' sum to 0.5 %.
            CHECK(std::fabs(opacity - 1) <= 0.01);
            CHECK(std::fabs(ratio - 1) <= 0.01 + second_order(c) + 4.5 * error);
        }
}

TEST_CASE("single scattering: albedo and irradiance per channel") {
    const Picture p = render_one(
        scene_from(kText, {"medium.0.albedo=[1, 0.5, 0.25]", "collectors.photons=2000000"}));
    const double source = hg(0.85, 0) * double(p.at("A", 24, 24));
    CHECK(double(p.at("R", 24, 24)) == doctest::Approx(2 * source).epsilon(0.02));
    CHECK(double(p.at("G", 24, 24)) == doctest::Approx(0.5 * source).epsilon(0.02));
    CHECK(double(p.at("B", 24, 24)) == doctest::Approx(0.125 * source).epsilon(0.02));
}
