// SPDX-License-Identifier: Apache-2.0
// Discrete ordinates of a sky in place: known limits, the grid's own, frames without a past.
// in: layers, lights, cameras -> out: pictures within stated bounds.
// docs/ordinates.md, "Skies"
#include <cmath>
#include <cstdlib>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

/// A layer of one density, 800 m thick, without end; seen from above and aslant.
std::string even_layer(double depth, const char* sun) {
    unsetenv("HOME"), unsetenv("PILEUS_CACHE_DIR"), unsetenv("XDG_CACHE_HOME");
    return std::string(R"(
camera = { projection = "orthographic", position_m = [0, -3000, 6200], target_m = [0, 0, 1000], height_m = 100, resolution = [4, 4] }
sky = { radiance = [0, 0, 0] }
sun = { azimuth_deg = 65, elevation_deg = )") +
           sun + R"( }
method = { name = "raymarch" }
[raymarch]
scattering = "ordinates"
steps = 200
light_steps = 40
light_first_step_m = 40
light_growth = 1.05
[output]
layers = ["cloud"]
[[medium]]
extinction_per_m = )" +
           std::to_string(depth / 800) + "\nphase = { type = \"henyey-greenstein\", g = 0.85 }\n";
}
constexpr const char* kSky =
    "density = \"procedural:sky\"\nresolution = [8, 8, 4]\n"
    "sky = { size = 32, threshold_low = -4, threshold_high = -3, base_density = 1, rounding = 0,"
    " base_rise = 0, top_fall = 0, base_m = 1000, top_m = 1800 }\n";
constexpr const char* kBox =
    "density = \"uniform:box\"\nbounds_m = [[-400, -400, 1000], [400, 400, 1800]]\n"
    "resolution = [2, 2, 32]\nboundary = \"periodic\"\n";

double mean_of(const Scene& scene, const char* channel) {
    const Picture p = render_one(scene);
    return sum_of(p, channel).value / (p.image.width * p.image.height);
}

std::string broken_sky(const char* camera, const char* more) {
    unsetenv("HOME"), unsetenv("PILEUS_CACHE_DIR"), unsetenv("XDG_CACHE_HOME");
    return std::string("camera = { ") + camera + ", fov_deg = 60, resolution = [32, 18] }\n" + R"(
method = { name = "raymarch" }
[raymarch]
scattering = "ordinates"
steps = 256
light_steps = 6
light_first_step_m = 60
light_growth = 1.8
stop_below = 1e-4
[[medium]]
density = "procedural:sky"
resolution = [16, 16, 4]
extinction_per_m = 0.03
phase = { type = "henyey-greenstein", g = 0.8 }
sky = { size = 32, perlin_m = 4096, worley_m = 1500, coverage = 0.5, base_m = 1000, top_m = 2000, planet_radius_m = 6.371e6 }
)" + more;
}

}  // namespace

TEST_CASE("sky ordinates: an even layer has the light of a slab of the same depth") {
    for (const char* sun : {"90", "45", "15"})
        for (const double depth : {0.5, 4.0, 20.0}) {
            CAPTURE(sun);
            CAPTURE(depth);
            const std::string text = even_layer(depth, sun);
            const double sky = mean_of(scene_from(text + kSky), "cloud.R");
            const double slab = mean_of(scene_from(text + kBox), "cloud.R");
            MESSAGE("sky over slab - 1: " << sky / slab - 1);
            // Nodes are 16 in height where the slab has 32; measured 0.0001 to 0.043.
            CHECK(std::fabs(sky / slab - 1) < 0.05);
        }
}

TEST_CASE("sky ordinates: in even light from all sides clouds are as bright as the sky") {
    for (const char* camera : {"position_m = [0, 0, 200], target_m = [300, 3000, 1400]",
                               "position_m = [50, -20, 1500], target_m = [300, 3000, 1400]",
                               "position_m = [-400, 90, 4000], target_m = [300, 3000, 1400]"}) {
        CAPTURE(camera);
        const Picture p = render_one(scene_from(
            broken_sky(camera, "[sky]\nradiance = [1, 1, 1]\n[sun]\nirradiance = [0, 0, 0]\n")));
        double least = 2, most = 0;
        for (int y = 0; y < p.image.height; ++y)
            for (int x = 0; x < p.image.width; ++x) {
                least = std::min(least, double(p.at("R", x, y)));
                most = std::max(most, double(p.at("R", x, y)));
            }
        MESSAGE("from " << least << " to " << most);
        // Iterations end at a change of 2e-4 of the norm; 32 directions hold a constant exactly.
        CHECK(least > 0.99);
        CHECK(most < 1.01);
    }
}

TEST_CASE("sky ordinates: a frame has the bits of a run that begins with it") {
    // The camera flies through the layer over several moves of the finest level, the sun rises.
    const std::string text =
        broken_sky("position_m = [0, 0, 900], target_m = [300, 3000, 1400]",
                   "[sky]\nradiance = [0.1, 0.2, 0.4]\n[ground]\nalbedo = 0.2\n"
                   "[sun]\nazimuth_deg = 60\nelevation_deg = 29\n"
                   "[animation]\nframes = 4\n"
                   "[[animation.keys]]\nframe = 0\nsun_elevation_deg = 29\n"
                   "camera_position_m = [0, 0, 900]\n"
                   "[[animation.keys]]\nframe = 3\nsun_elevation_deg = 32\n"
                   "camera_position_m = [900, 600, 1500]\n");
    RenderOptions all, last;
    all.last_frame = last.first_frame = last.last_frame = 3;
    for (const int threads : {1, 3}) {
        all.threads = threads;
        const Scene scene = scene_from(text);
        CHECK(pixels_of(render_one(scene, all)) == pixels_of(render_one(scene, last)));
    }
}

TEST_CASE("sky ordinates: corners") {
    const char* below = "position_m = [0, 0, 200], target_m = [300, 3000, 1400]";
    constexpr const char* kHigh = "sun.elevation_deg=90";
    const char* const corners[][2] = {
        {kHigh, "medium.0.sky.seed=2"},
        {"sun.elevation_deg=0", "medium.0.sky.seed=2"},
        {"sun.elevation_deg=-10", "medium.0.sky.seed=2"},
        {"sun.irradiance=[0,0,0]", "medium.0.sky.seed=2"},
        {kHigh, "medium.0.extinction_per_m=0"},
        {kHigh, "medium.0.extinction_per_m=1e-9"},
        {kHigh, "medium.0.extinction_per_m=10"},
        {"sun.elevation_deg=0", "medium.0.extinction_per_m=10"},
        {kHigh, "medium.0.albedo=[1,0.5,0]"},
        {kHigh, "medium.0.sky.coverage=0"},
        {kHigh, "medium.0.sky.coverage=1"},
        {kHigh, "medium.0.sky.planet_radius_m=0"},
        {kHigh, "raymarch.light_steps=0"},
        {kHigh, "raymarch.scale=2"},
        {kHigh, "camera.resolution=[1,1]"},
        {kHigh, "medium.0.bounds_m=[[-2000,-900,1200],[3000,900,1500]]"}};
    for (const auto& corner : corners) {
        const std::string sun = corner[0], set = corner[1];
        CAPTURE(sun);
        CAPTURE(set);
        const Picture p = render_one(scene_from(
            broken_sky(below, "[sky]\nradiance = [0.1, 0.2, 0.4]\n[sun]\n"), {sun, set}));
        // A sun of irradiance 1 over an albedo of 1 brings less than 1/pi on the mean; ten times
        // that within a narrow lobe.
        for (const float v : pixels_of(p)) {
            CHECK(v >= 0);
            CHECK(v < 3);
        }
    }
}
