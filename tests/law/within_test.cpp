// SPDX-License-Identifier: Apache-2.0
// A camera within a medium sees nodes around it from many sides: `directions = "all"` shows that.
// in: a thin layer of strong forward scattering -> out: pass or fail.
// docs/collectors.md, "From within a medium"
#include <cmath>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

constexpr const char* kLayer = R"(
seed = 3
[camera]
position_m = [0, -600, 500]
target_m = [0, 0, 540]
fov_deg = 60
resolution = [16, 16]
[sun]
azimuth_deg = 40
elevation_deg = 35
[ground]
altitude_m = 0
albedo = 0.2
[collectors]
photons = 300_000
[path]
samples_per_pixel = 512
[[medium]]
density = "uniform:box"
bounds_m = [[-1500, -1500, 400], [1500, 1500, 600]]
resolution = [60, 60, 16]
extinction_per_m = 0.01
phase = { type = "henyey-greenstein", g = 0.85 }
)";

double mean(const std::vector<std::string>& more) {
    const Picture p = render_one(scene_from(kLayer, more));
    return sum_of(p, "G").value / (p.image.width * p.image.height);
}

}  // namespace

TEST_CASE("within a medium: bands along each ray, against paths") {
    const double paths = mean({"method.name=path"});
    const double line = mean({}), all = mean({"collectors.directions=all"});
    // Four bands of strong forward scattering stay 8 % too dark around the sun, and the light
    // along the line to the camera is wrong by a fifth and more.
    CHECK(std::fabs(all / paths - 1) < 0.12);
    CHECK(line / paths < 0.85);
}

TEST_CASE("within a medium: a parallel camera has one direction, and needs none of it") {
    const std::vector<std::string> parallel = {"method.name=collectors"};
    std::string text = kLayer;
    text.replace(text.find("fov_deg = 60"), 12, "projection = \"orthographic\"\nheight_m = 900");
    const Picture one = render_one(scene_from(text, parallel));
    const Picture all = render_one(scene_from(text, {"collectors.directions=all"}));
    for (const char* c : {"R", "A"})
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) CHECK(one.at(c, x, y) == all.at(c, x, y));
}
