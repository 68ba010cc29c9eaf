// SPDX-License-Identifier: Apache-2.0
// Thin clouds with tables of phase functions: single scattering in closed form, glory included.
// in: boxes of optical depth 1e-3 and two media with tables of their own -> out: radiances.
// docs/phase.md, "Collectors and narrow peaks"; the first order keeps the exact phase function.
#include <cmath>
#include <cstdio>

#include "src/world/phase/medium_phase.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

// The camera looks north; the sun's azimuth sets the angle, 180 degrees behind the camera.
const char* const kText = R"(
seed = 5
camera = { position_m = [0, -300, 0], target_m = [0, 0, 0], projection = "orthographic", height_m = 60, resolution = [8, 8] }
sun = { azimuth_deg = 180, elevation_deg = 0, irradiance = [1, 1, 1] }
collectors = { photons = 20_000, generations = 1, samples = 500 }
[[medium]]
density = "uniform:box"
bounds_m = [[-50, -25, -50], [50, 25, 50]]
resolution = [20, 10, 20]
extinction_per_m = 2e-5
phase = { type = "cloud", effective_radius_um = 10 }
)";

/// Density at the turn from a sun at this azimuth to a camera in the south.
double density_at(const PhaseParams& p, double azimuth_deg) {
    return double(phase_density(p, float(1 - std::cos(azimuth_deg * 3.14159265358979 / 180))));
}

double middle(const std::vector<std::string>& overrides, const char* text = kText) {
    const Picture p = render_one(scene_from(text, overrides));
    return double(p.at("G", 4, 4));
}

}  // namespace

TEST_CASE(
    "tables: thin clouds show the phase function itself, in the peak, the bow and the glory") {
    PhaseStore cloud;
    REQUIRE(make_cloud_phase(10, cloud));
    for (const double azimuth : {0.0, 1.0, 20.0, 100.0, 140.0, 178.5, 180.0}) {
        const double seen = middle({"sun.azimuth_deg=" + std::to_string(azimuth)});
        const double p = density_at(cloud.params(), azimuth);
        const double expected = p * 2e-5 * 50;
        std::printf("sun at %5g: radiance %.5g, closed form %.5g\n", azimuth, seen, expected);
        // The way through dims by 1e-3. The second order is mean over single scattering,
        // 1/(4 pi p), times the depth; photons that bring it are few.
        const double second = 2e-3 / (4 * 3.14159265358979 * p);
        CHECK(std::fabs(seen / expected - 1) <= 5e-3 + 4 * second);
    }
}

TEST_CASE("tables: billboards show the first order in proportion to the phase function") {
    PhaseStore ten, five;
    REQUIRE(make_cloud_phase(10, ten));
    REQUIRE(make_cloud_phase(5, five));
    for (const double azimuth : {1.0, 30.0, 142.0, 179.0}) {
        double sum[2] = {};
        for (int i = 0; i < 2; ++i) {
            const Picture p = render_one(scene_from(
                kText, {"sun.azimuth_deg=" + std::to_string(azimuth),
                        "collectors.display=billboards", "camera.resolution=[64, 64]",
                        std::string("medium.0.phase.effective_radius_um=") + (i ? "5" : "10")}));
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x) sum[i] += double(p.at("G", x, y));
        }
        // The same photons meet the same collectors; those that turned once are one in a thousand.
        const double ratio = density_at(ten.params(), azimuth) / density_at(five.params(), azimuth);
        std::printf("billboards, sun at %g: ratio %.4f, closed form %.4f\n", azimuth,
                    sum[0] / sum[1], ratio);
        CHECK(sum[1] > 0);
        CHECK(sum[0] / sum[1] == doctest::Approx(ratio).epsilon(2e-3));
    }
}

TEST_CASE("tables: two media that overlap keep their own") {
    const std::string text = std::string(kText) +
                             "[[medium]]\ndensity = \"uniform:box\"\n"
                             "bounds_m = [[-50, -25, -50], [50, 25, 50]]\n"
                             "extinction_per_m = 1e-5\n"
                             "phase = { type = \"cloud\", effective_radius_um = 5 }\n";
    PhaseStore ten, five;
    REQUIRE(make_cloud_phase(10, ten));
    REQUIRE(make_cloud_phase(5, five));
    for (const double azimuth : {0.5, 90.0, 179.0})
        for (const char* closure : {"closure=sh", "closure=camera"}) {
            const double seen = middle({"sun.azimuth_deg=" + std::to_string(azimuth),
                                        std::string("collectors.") + closure},
                                       text.c_str());
            const double expected = (2e-5 * density_at(ten.params(), azimuth) +
                                     1e-5 * density_at(five.params(), azimuth)) *
                                    50;
            const double second = 3e-3 * 1.5e-3 / (4 * 3.14159265358979 * expected);
            CHECK(std::fabs(seen / expected - 1) <= 5e-3 + 4 * second);
        }
}
