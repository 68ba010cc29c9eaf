// SPDX-License-Identifier: Apache-2.0
// Marched light of point, spot and parallel lights is what paths of one scattering bring; photons
// bring the rest.
// in: a box, an uneven cloud, a ground under lamps -> out: both methods' pixels, their difference.
// docs/lights.md, "By marching", "By photons". Bounds: 4 standard errors of the paths, and 1% for
// nodes and steps.
#include <cmath>
#include <initializer_list>

#include "tests/support/long_tests.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

constexpr double kPiD = 3.14159265358979323846;

constexpr const char* kView = R"(
[camera]
position_m = [0, -300, 60]
target_m = [0, 0, 50]
fov_deg = 24
resolution = [10, 8]
[path]
samples_per_pixel = 4000
max_depth = 1
pixel = "centre"
[output]
layers = ["radiance", "alpha", "error"]
)";

constexpr const char* kBox = R"(
[[medium]]
density = "uniform:box"
bounds_m = [[-50, -50, 0], [50, 50, 100]]
resolution = [20, 20, 20]
extinction_per_m = 0.02
albedo = [0.9, 0.8, 1.0]
phase = { type = "henyey-greenstein", g = 0.4 }
)";

constexpr const char* kCloud = R"(
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-60, -60, 0], [60, 60, 100]]
resolution = [24, 24, 20]
extinction_per_m = 0.05
phase = { type = "henyey-greenstein", g = 0.6 }
)";

constexpr const char* kPointLight = R"(
[[light]]
type = "point"
position_m = [12, -8, 45]
intensity = [900, 600, 300]
)";

constexpr const char* kSpotLight = R"(
[[light]]
type = "spot"
position_m = [-140, -40, 20]
target_m = [0, 0, 60]
cone_deg = 30
penumbra_deg = 8
intensity = 40000
)";

constexpr const char* kMoon = R"(
[[light]]
type = "directional"
azimuth_deg = 70
elevation_deg = 40
)";

bool shot(const std::string& method) { return method == "collectors" || method == "photon-grid"; }

Picture by(const char* method, const std::string& text) {
    Scene scene = scene_from("[method]\nname = \"" + std::string(method) + "\"\n" + text);
    if (scene.method != "path") scene.output.layer_error = false;
    scene.output.layer_order = shot(scene.method);
    return render_one(scene);
}

/// Media and lights in pairs: in the plain form each light in one of the media.
template <class Check>
void each_pair(std::initializer_list<const char*> lights, Check check) {
    std::size_t first = 0;
    for (const char* medium : {kBox, kCloud}) {
        std::size_t number = first++;
        for (const char* light : lights)
            if (number++ % pileus::row_stride(2) == 0) check(medium, light);
    }
}

constexpr const char* kOnce = "[raymarch]\nscattering = \"single\"\n";

TEST_CASE("marched lamps are paths of one scattering") {
    each_pair({kPointLight, kSpotLight, kMoon}, [](const char* medium, const char* light) {
        CAPTURE(light);
        const std::string text = std::string(kView) + kOnce + medium + light;
        const Picture path = by("path", text);
        for (const char* method : {"raymarch", "collectors", "photon-grid"}) {
            CAPTURE(method);
            const Picture march = by(method, text);
            for (const char* channel : {"R", "B"}) {
                const PixelSum a = sum_of(path, channel);
                const std::string shown = (shot(method) ? "single." : "") + std::string(channel);
                const PixelSum b = sum_of(march, shown);
                MESSAGE(std::string(method) << " " << std::string(channel) << " path " << a.value
                                            << " +- " << a.error << " march " << b.value);
                CHECK(a.error < 0.02 * a.value);
                CHECK(std::fabs(a.value - b.value) < 4 * a.error + 0.01 * a.value);
            }
        }
    });
}

TEST_CASE("photons of lamps bring what is scattered more than once") {
    std::string view = kView;
    view.replace(view.find("max_depth = 1\n"), 14, "");
    view += "[photon_grid]\nphotons = 400000\n[collectors]\nphotons = 400000\n";
    const std::string day = "[sun]\nelevation_deg = 30\n[ground]\naltitude_m = -10\nalbedo = 0.5\n";
    const std::string dark = "[ground]\naltitude_m = -10\nalbedo = 0.5\n";
    each_pair({kPointLight, kSpotLight, kMoon, ""}, [&](const char* medium, const char* light) {
        CAPTURE(light);
        const std::string text = view + medium + (*light != 0 ? dark : day) + light;
        const Picture path = by("path", text);
        for (const char* method : {"collectors", "photon-grid"}) {
            CAPTURE(method);
            const Picture own = by(method, text);
            for (const char* channel : {"R", "B"}) {
                const PixelSum a = sum_of(path, channel);
                const PixelSum b = sum_of(own, channel);
                MESSAGE(std::string(method)
                        << " " << std::string(channel) << " path " << a.value << " +- " << a.error
                        << " photons " << b.value << " " << b.value / a.value - 1);
                // Two per cent for harmonics and noise: 1.9 at most where paths have 1.1.
                CHECK(std::fabs(a.value - b.value) < 4 * a.error + 0.02 * a.value);
            }
        }
    });
}

TEST_CASE("a parallel light by octaves is the sun by octaves") {
    const std::string octaves = "[raymarch]\nscattering = \"octaves\"\nsteps = 200\n";
    for (const char* medium : {kBox, kCloud}) {
        const std::string view = std::string(kView) + octaves + medium;
        const Picture lamp = by("raymarch", view + kMoon);
        const Picture sun = by("raymarch", view + "[sun]\nazimuth_deg = 70\nelevation_deg = 40\n");
        const Picture once = by("raymarch", std::string(kView) + kOnce + medium + kMoon);
        for (const char* channel : {"R", "B"}) {
            const double a = sum_of(lamp, channel).value;
            const double b = sum_of(sun, channel).value;
            CHECK(a > 1.5 * sum_of(once, channel).value);
            // Steps and nodes of their own.
            CHECK(std::fabs(a - b) < 0.02 * b);
        }
    }
}

TEST_CASE("marched lamps light the ground through a medium that absorbs") {
    const char* down = R"(
[camera]
position_m = [0, 0, 400]
target_m = [0, 0, 0]
up = [0, 1, 0]
projection = "orthographic"
height_m = 0.001
resolution = [1, 1]
[ground]
altitude_m = 0
albedo = 0.5
[[medium]]
density = "uniform:box"
bounds_m = [[-50, -50, 0], [50, 50, 100]]
resolution = [20, 20, 20]
extinction_per_m = 0.02
albedo = 0
[[light]]
type = "point"
position_m = [0, 30, 40]
intensity = 5000
[[light]]
type = "point"
position_m = [0, 0, -1]
intensity = 5000
[output]
layers = ["radiance", "alpha"]
)";
    // 50 m of medium to the light, 100 m to the camera; the second light is below the ground.
    const double exact = 0.5 / kPiD * 5000 / 2500 * (40.0 / 50) * std::exp(-0.02 * 150);
    for (const char* method : {"raymarch", "collectors", "photon-grid"})
        CHECK(double(by(method, down).at("G", 0, 0)) == doctest::Approx(exact).epsilon(2e-3));
}

}  // namespace
