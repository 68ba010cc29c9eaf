// SPDX-License-Identifier: Apache-2.0
// Light that turns within the peak of a phase function goes on as it came, in marched photon
// methods.
// in: thin layers of droplets seen from above -> out: means against paths.
// docs/methods.md 3, repair 7
#include <cmath>

#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;

namespace {

/// A layer of 0.2 optical depths over a black ground under an even sky.
constexpr const char* kThin = R"(
seed = 3
[camera]
position_m = [0, 0, 3000]
target_m = [0, 1, 0]
projection = "orthographic"
height_m = 600
resolution = [8, 8]
[sky]
radiance = 1
[ground]
altitude_m = 0
albedo = 0
[collectors]
photons = 400_000
[photon_grid]
photons = 400_000
[path]
samples_per_pixel = 1024
[[medium]]
density = "uniform:box"
bounds_m = [[-1500, -1500, 400], [1500, 1500, 600]]
resolution = [15, 15, 4]
extinction_per_m = 0.001
phase = { type = "cloud", effective_radius_um = 10 }
)";
constexpr const char* kPhotons[] = {"collectors", "photon-grid"};

double mean_of(const char* method, std::vector<std::string> more, const std::string& text = "") {
    const test::TempFolder folder;
    // A level plate below the layer.
    folder.put("plate.obj",
               "v -900 -900 200\nv 900 -900 200\nv 900 900 200\nv -900 900 200\nf 1 2 3 4\n");
    more.push_back(std::string("method.name=") + method);
    Scene scene = scene_from(std::string(kThin) + text, more);
    scene.directory = folder.path("");
    const Picture p = render_one(scene);
    return sum_of(p, "G").value / (p.image.width * p.image.height);
}

void check_near(const std::vector<std::string>& more, double most, const std::string& text = "") {
    const double paths = mean_of("path", more, text);
    for (const char* method : kPhotons) {
        CAPTURE(method);
        const double ratio = mean_of(method, more, text) / paths;
        CAPTURE(ratio);
        CHECK(std::fabs(ratio - 1) < most);
    }
}

}  // namespace

TEST_CASE("peak: thin droplets from above over a dark ground have little light") {
    // 0.8 % of the sky, what four bands leave of two large lights that cancel; six leave 3 %.
    check_near({}, 0.5);
    const double paths = mean_of("path", {});
    CHECK(mean_of("photon-grid", {"photon_grid.peak_deg=0"}) / paths > 2.5);
    CHECK(mean_of("collectors", {"collectors.peak_deg=0"}) / paths > 2.5);
}

TEST_CASE("peak: what lies behind shines through, sky, ground or solid") {
    const std::string plate = "[[solid]]\nfile = \"plate.obj\"\nalbedo = 0.5\n";
    check_near({"ground.albedo=0.6"}, 0.02);
    // Light that the layer sends onto the plate is not all there (docs/solids.md); 12 % without.
    check_near({}, 0.08, plate);
    check_near({"camera.position_m=[0,0,10]", "camera.target_m=[0,1,600]"}, 0.02);
    // A ray of two degrees over the horizon, which half of the peak's turns come from below.
    check_near(
        {"camera.position_m=[0,-2500,450]", "camera.target_m=[0,0,520]", "camera.height_m=100"},
        0.05);
}

TEST_CASE("peak: several media and colours have peaks of their own") {
    const std::string second =
        "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[-1500, -1500, 400], [1500, 1500, "
        "600]]\nresolution = [15, 15, 4]\nextinction_per_m = 0.0005\nalbedo = [0.9, 0.8, 0.7]\n"
        "phase = { type = \"henyey-greenstein\", g = 0.95 }\n";
    check_near({}, 0.5, second);
    check_near({"ground.albedo=0.6", "medium.0.albedo=[1,0.9,0.8]"}, 0.02, second);
}

TEST_CASE("peak: a constant sky is seen unchanged through white media, whatever their peak") {
    for (const char* method : kPhotons) {
        CAPTURE(method);
        const double seen = mean_of(method, {"ground.albedo=1", "medium.0.extinction_per_m=0.02"});
        CHECK(std::fabs(seen - 1) < 0.01);
    }
}
