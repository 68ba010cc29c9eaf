// SPDX-License-Identifier: Apache-2.0
// Marched light of point, spot and parallel lights is what paths of one scattering bring.
// in: a box, an uneven cloud, a ground under lamps -> out: both methods' pixels, their difference.
// docs/lights.md, "By marching". Bounds: 4 standard errors of the paths, and 1% for nodes and
// steps.
#include <cmath>

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

struct Sum {
    double value = 0, error = 0;
};
Sum sum_of(const Picture& p, const char* channel, const char* error) {
    Sum s;
    for (int y = 0; y < p.image.height; ++y)
        for (int x = 0; x < p.image.width; ++x) {
            s.value += double(p.at(channel, x, y));
            if (error != nullptr) s.error += std::pow(double(p.at(error, x, y)), 2);
        }
    s.error = std::sqrt(s.error);
    return s;
}

Picture by(const char* method, const std::string& text) {
    Scene scene = scene_from("[method]\nname = \"" + std::string(method) + "\"\n" + text);
    if (scene.method != "path") scene.output.layer_error = false;
    return render_one(scene);
}

TEST_CASE("marched lamps are paths of one scattering") {
    for (const char* medium : {kBox, kCloud})
        for (const char* light : {kPointLight, kSpotLight, kMoon}) {
            CAPTURE(light);
            const std::string text = std::string(kView) + medium + light;
            const Picture path = by("path", text);
            for (const char* method : {"raymarch", "collectors", "photon-grid"}) {
                CAPTURE(method);
                const Picture march = by(method, text);
                for (const char* channel : {"R", "B"}) {
                    const std::string error = std::string("error.") + channel;
                    const Sum a = sum_of(path, channel, error.c_str());
                    const Sum b = sum_of(march, channel, nullptr);
                    MESSAGE(std::string(method)
                            << " " << std::string(channel) << " path " << a.value << " +- "
                            << a.error << " march " << b.value);
                    CHECK(a.error < 0.02 * a.value);
                    CHECK(std::fabs(a.value - b.value) < 4 * a.error + 0.01 * a.value);
                }
            }
        }
}

TEST_CASE("photons of sun and sky are those of the scene without lamps, whose light is added") {
    constexpr const char* kDay = R"(
[sun]
elevation_deg = 30
[sky]
radiance = [0.1, 0.2, 0.3]
[ground]
altitude_m = -10
albedo = 0.3
[photon_grid]
photons = 4000
generations = 4
[collectors]
photons = 4000
generations = 4
samples = 500
)";
    std::string view = kView;
    view.replace(view.find("\"error\""), 7, "\"error\", \"order\", \"light\"");
    for (const char* method : {"collectors", "photon-grid"}) {
        CAPTURE(method);
        const std::string named = "[method]\nname = \"" + std::string(method) + "\"\n";
        const auto shown = [&](const std::string& rest) {
            return render_one(scene_from(named + view + kBox + rest));
        };
        const std::string ground = "[ground]\naltitude_m = -10\nalbedo = 0.3\n";
        const Picture day = shown(kDay), lamp = shown(ground + kPointLight);
        const Picture both = shown(std::string(kDay) + kPointLight);
        double most = 0;
        for (int y = 0; y < both.image.height; ++y)
            for (int x = 0; x < both.image.width; ++x) {
                const auto adds = [&](const char* channel, double lamps) {
                    const double sum = double(day.at(channel, x, y)) + lamps;
                    // Sums of floats: some roundings of 6e-8 each.
                    CHECK(double(both.at(channel, x, y)) == doctest::Approx(sum).epsilon(2e-6));
                };
                const double own = double(lamp.at("R", x, y));
                most = own > most ? own : most;
                adds("R", own);
                adds("single.R", double(lamp.at("single.R", x, y)));
                adds("sun.R", 0);
                // The same light in every batch has no spread; roundings of the batches alone.
                CHECK(both.at("error.R", x, y) == day.at("error.R", x, y));
                CHECK(lamp.at("multiple.R", x, y) == 0.0f);
            }
        CHECK(most > 0.01);
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
