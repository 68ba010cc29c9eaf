// SPDX-License-Identifier: Apache-2.0
// Sky maps under the path tracer: against a constant sky, and a bright spot against a sun.
// in: maps of one colour, maps of one bright texel -> out: radiances that must agree.
// docs/path.md "Sky maps": phase and map sampling together, by the balance heuristic.
#include "tests/support/path_harness.h"
#include "tests/support/quadrature.h"
#include "tests/support/sky_images.h"

namespace {

using namespace path_test;
using namespace sky_test;

/// A box of three unequal sides, some optical depths thick, absorbing a little.
Rig make_box(float g) {
    Rig rig = make_rig({4, 3, 2}, {40, 30, 20}, 0.1);
    rig.medium.optics[0].phase.g1 = g;
    set_albedo(rig, {0.95f, 0.95f, 0.95f});
    set_majorants(rig, 2);
    return rig;
}

CameraParams side_view() { return make_view({20, -40, 12}, {0, 1, 0}, 8, 8); }

/// The same picture's mean under two lights.
void check_equal_light(const std::string& name, const Rig& a, const Rig& b, unsigned samples,
                       double model = 0) {
    double scale = 0;
    check_mean(
        name, 0,
        [&](int more, std::uint64_t seed) {
            const unsigned n = samples * unsigned(more);
            const Mean ma = film_average(trace_film(path_input(a, side_view(), seed), n));
            const Mean mb = film_average(trace_film(path_input(b, side_view(), seed + 1), n));
            scale = mb.value;
            // In units of the light itself, so that `model` is a relative error.
            return Mean{(ma.value - mb.value) / mb.value,
                        std::sqrt(ma.error * ma.error + mb.error * mb.error) / mb.value};
        },
        model);
    CHECK(scale > 0);
}

TEST_CASE("a map of one colour is a constant sky") {
    const Image even = sky_image(7, 5, [](int, int, int) { return 1.0; });
    for (bool ground : {false, true})
        for (float g : {0.0f, 0.9f}) {
            Rig constant = make_box(g), mapped = make_box(g);
            const SkyMap map = sky_map_of(even, ground, mapped.medium.extent_m, 10);
            set_sky(constant, 1);
            mapped.lighting.map = map.view;
            if (ground) {
                set_ground(constant, -5, 0.4);
                set_ground(mapped, -5, 0.4);
            }
            char name[64];
            std::snprintf(name, sizeof name, "even map, g %g, %s", double(g),
                          ground ? "ground" : "no ground");
            check_equal_light(name, mapped, constant, 600);
        }
}

TEST_CASE("a bright spot of the sky is a sun of its irradiance") {
    // One texel of 1/16 degree near the zenith angle of 45 degrees, towards the east.
    constexpr int kWidth = 2880, kHeight = 1440, kRow = 360, kColumn = kWidth / 4 * 3;
    const Image spot = sky_image(kWidth, kHeight, [](int row, int column, int) {
        return row == kRow && column == kColumn ? 1e5 : 0.0;
    });
    for (bool ground : {false, true}) {
        Rig sun = make_box(0.6f), mapped = make_box(0.6f);
        const SkyMap map = sky_map_of(spot, ground, mapped.medium.extent_m, 0);
        mapped.lighting.map = map.view;
        const double theta = (kRow + 0.5) / kHeight * kPi64;
        const double phi = (double(kColumn) + 0.5) / kWidth * 2 * kPi64 - kPi64;
        // The tent's integral is that of a texel, to the square of its width.
        const double texel = 2 * kPi64 / kWidth * (kPi64 / kHeight) * std::sin(theta);
        shine(sun,
              {float(std::sin(theta) * std::sin(phi)), float(std::sin(theta) * std::cos(phi)),
               float(std::cos(theta))},
              1e5 * texel);
        if (ground) {
            set_ground(sun, -5, 0.4);
            set_ground(mapped, -5, 0.4);
        }
        check_equal_light(ground ? "spot on a cloud over ground" : "spot on a cloud", mapped, sun,
                          9000, 1e-5);
    }
}

TEST_CASE("directions drawn from a map have the density that is said") {
    for (bool ground : {false, true}) {
        const double box[3] = {1, 1, 1};
        const SkyMap map = sky_map_of(rough_sky(9, 7, true), ground, box, 33);
        PathSky sky;
        REQUIRE(make_path_sky(map.view, sky));
        // Whole sky: the density integrates to 1.
        double whole = 0;
        constexpr int kRows = 1400, kColumns = 900;
        for (int i = 0; i < kRows; ++i)
            for (int j = 0; j < kColumns; ++j) {
                const double theta = (i + 0.5) / kRows * kPi64 * (ground ? 0.5 : 1);
                const double phi = (j + 0.5) / kColumns * 2 * kPi64;
                const Vec<float> d{float(std::sin(theta) * std::sin(phi)),
                                   float(std::sin(theta) * std::cos(phi)), float(std::cos(theta))};
                whole += double(sky_density(map.view, sky.view, d)) * std::sin(theta);
            }
        whole *= kPi64 * (ground ? 0.5 : 1) / kRows * 2 * kPi64 / kColumns;
        CHECK(whole == doctest::Approx(1).epsilon(1e-5));

        // The mean of radiance over density is the light of the sky, whatever the density.
        for (int c = 0; c < 3; ++c) {
            double exact = 0;
            for (int i = 0; i < kRows; ++i)
                for (int j = 0; j < kColumns; ++j) {
                    const double theta = (i + 0.5) / kRows * kPi64 * (ground ? 0.5 : 1);
                    const double phi = (j + 0.5) / kColumns * 2 * kPi64;
                    exact += radiance_at(map, theta, phi, c) * std::sin(theta);
                }
            exact *= kPi64 * (ground ? 0.5 : 1) / kRows * 2 * kPi64 / kColumns;
            check_mean(
                "light of a rough sky, channel " + std::to_string(c) + (ground ? ", ground" : ""),
                exact,
                [&](int more, std::uint64_t seed) {
                    const int n = 20000 * more;
                    double sum = 0, square = 0;
                    for (int i = 0; i < n; ++i) {
                        const auto a = threefry(std::uint32_t(seed), 5u, std::uint32_t(i), 0u);
                        const auto b = threefry(std::uint32_t(seed), 5u, std::uint32_t(i), 1u);
                        const Vec<float> d = draw_sky<float>(map.view, sky.view, a, b);
                        const Vec<float> light = map_radiance(map.view, d);
                        const float channel[3] = {light.x, light.y, light.z};
                        const double v =
                            double(channel[c]) / double(sky_density(map.view, sky.view, d));
                        sum += v;
                        square += v * v;
                    }
                    const double mean = sum / n;
                    return Mean{mean, std::sqrt((square / n - mean * mean) / (n - 1))};
                },
                exact * 2e-6);
        }
    }
}

}  // namespace
