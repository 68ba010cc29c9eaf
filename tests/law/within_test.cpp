// SPDX-License-Identifier: Apache-2.0
// A camera within a medium sees nodes around it from many sides: each ray reads what leaves along
// it, of nodes around the camera or of all of them.
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

TEST_CASE("within a medium: nodes around the camera show each ray its own light, against paths") {
    const double paths = mean({"method.name=path"});
    const double line = mean({"collectors.directions=camera"}), near = mean({}),
                 all = mean({"collectors.directions=all"});
    // The light along the line to the camera is wrong by a seventh. Farther nodes change 2 % at
    // most; what is left are leaves as high as half the layer (docs/collectors.md, "From within").
    CHECK(line / paths < 0.9);
    CHECK(std::fabs(near / paths - 1) < 0.1);
    CHECK(std::fabs(near / all - 1) < 0.02);
}

TEST_CASE("within a medium: cells around the camera, against paths") {
    const std::vector<std::string> grid = {"method.name=photon-grid",
                                           "photon_grid.photons=3000000"};
    std::vector<std::string> old = grid;
    old.push_back("photon_grid.directions=camera");
    const double paths = mean({"method.name=path"});
    // 2.5 %: two standard errors, of photons and paths 1 % each. Fewer photons gather in coarser
    // cells, which blur a layer of this height by 8 %.
    CHECK(std::fabs(mean(grid) / paths - 1) < 0.025);
    CHECK(mean(old) / paths < 0.95);
}

TEST_CASE("within a medium: the layers of a picture change none of its pixels") {
    for (const char* method : {"method.name=collectors", "method.name=photon-grid"}) {
        const Picture plain = render_one(scene_from(kLayer, {method}));
        const Picture error = render_one(
            scene_from(kLayer, {method, "output.layers=[\"error\", \"light\", \"order\"]"}));
        for (const char* c : {"R", "G", "B"})
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 16; ++x) CHECK(plain.at(c, x, y) == error.at(c, x, y));
    }
}

TEST_CASE("beside a medium: a camera that comes near sees what all nodes show along each ray") {
    // Nodes are 50 m apart along x and y: they count up to 300 m from the camera, here down to
    // 900 m over the ground.
    for (int height = 950; height >= 550; height -= 50) {
        const std::string at = "camera.position_m=[0,-600," + std::to_string(height) + "]";
        const std::string to = "camera.target_m=[0,0," + std::to_string(height - 400) + "]";
        const double near = mean({at, to});
        if (height > 900) CHECK(near == mean({at, to, "collectors.directions=camera"}));
        // Light along one line is never less than none, that of all bands may be: 3 % here.
        CHECK(std::fabs(near / mean({at, to, "collectors.directions=all"}) - 1) < 0.05);
    }
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
