// SPDX-License-Identifier: Apache-2.0
// A flight through a layer: no seam at a tile's border, at base or top, nothing pops, no dark
// inside. in: frames of a camera that moves by a little and by much less -> out: pass or fail.
#include <cmath>
#include <cstdlib>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

std::string scene_text(double x, double y, double z) {
    unsetenv("HOME"), unsetenv("PILEUS_CACHE_DIR"), unsetenv("XDG_CACHE_HOME");
    const auto n = [](double v) { return std::to_string(v); };
    return "camera = { position_m = [" + n(x) + ", " + n(y) + ", " + n(z) + "], target_m = [" +
           n(x + 300) + ", " + n(y + 1000) + ", " + n(z + 60) +
           "], fov_deg = 60, resolution = [32, 18] }\n" + R"(
sun = { azimuth_deg = 60, elevation_deg = 30 }
sky = { radiance = [0.1, 0.2, 0.4] }
method = { name = "raymarch" }
raymarch = { steps = 512, spacing = "optimal", scattering = "octaves", light_steps = 4, light_first_step_m = 60, light_growth = 2 }
[[medium]]
density = "procedural:sky"
resolution = [16, 16, 4]
extinction_per_m = 0.01
phase = { type = "henyey-greenstein", g = 0.5 }
sky = { size = 32, perlin_m = 4096, worley_m = 1024, perlin_cells = 2, worley_cells = 2, threshold_low = 0.45, threshold_high = 0.6, base_m = 1000, top_m = 2000, base_rise = 0.3, top_fall = 0.4, rounding = 0.3, planet_radius_m = 6.371e6 }
)";
}

std::vector<float> frame(double x, double y, double z) {
    const Picture p = render_one(scene_from(scene_text(x, y, z)));
    std::vector<float> values;
    for (int row = 0; row < 18; ++row)
        for (int column = 0; column < 32; ++column)
            for (const char* channel : {"R", "G", "B"})
                values.push_back(p.at(channel, column, row));
    return values;
}

struct Change {
    double mean = 0, most = 0;
};
Change change(const std::vector<float>& a, const std::vector<float>& b) {
    Change c;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double d = std::fabs(double(a[i]) - double(b[i]));
        c.mean += d / double(a.size()), c.most = std::fmax(c.most, d);
    }
    return c;
}

}  // namespace

TEST_CASE("what changes from frame to frame is the motion, with its size") {
    // Along the layer through a tile's border at 0.8 x + 0.6 y = 4096 (tiles are turned), through
    // base and top, through a level's.
    const double starts[][3] = {
        {4080, 1380, 1400}, {500, 6150, 980}, {-900, 100, 1990}, {8190, -4100, 1500}};
    const double ways[][3] = {{1, 0, 0}, {0, 0.5, 0.9}, {0.3, 0.3, 0.9}, {0.1, 1, 0}};
    for (int i = 0; i < 4; ++i) {
        CAPTURE(i);
        const auto at = [&](double m) {
            return frame(starts[i][0] + m * ways[i][0], starts[i][1] + m * ways[i][1],
                         starts[i][2] + m * ways[i][2]);
        };
        // Over one interval, all of it at once and in eight steps: a motion's steps change an
        // eighth each, and a pop or a seam would be one step that changes as much as all.
        const double kWay = 32;
        std::vector<float> last = at(0);
        const std::vector<float> first = last;
        Change worst;
        for (int s = 1; s <= 8; ++s) {
            const std::vector<float> now = at(kWay * s / 8);
            const Change c = change(last, now);
            worst.mean = std::fmax(worst.mean, c.mean), worst.most = std::fmax(worst.most, c.most);
            last = now;
        }
        const Change whole = change(first, last);
        MESSAGE("step/way, mean " << worst.mean / whole.mean << ", most "
                                  << worst.most / whole.most);
        CHECK(whole.mean > 1e-4);
        // Pixels turn and return on the way: up to twice their share of the mean; single ones may
        // cross an edge within a step. Above the top (2) the steps of level rays begin anew, where
        // they next meet the layer, and so does what steps this long err by.
        const bool leaves = i == 2;
        CHECK(worst.mean < (leaves ? 0.45 : 0.25) * whole.mean);
        CHECK(worst.most < (leaves ? 1.2 : 0.4) * whole.most);
    }
}

TEST_CASE("inside a cloud it is as bright as the sky that shines into it") {
    // 100 m in every direction have an optical depth of one: the camera is in the cloud.
    const Picture p =
        render_one(scene_from(scene_text(700, 2300, 1450), {"medium.0.sky.coverage=1"}));
    double least = 1e9, mean = 0;
    for (int row = 0; row < 18; ++row)
        for (int column = 0; column < 32; ++column) {
            const double v = double(p.at("G", column, row));
            least = std::fmin(least, v), mean += v / (32 * 18);
        }
    MESSAGE("inside, green: least " << least << ", mean " << mean
                                    << ", sky 0.2, sun's mean 1/(4 pi)");
    // The sky alone gives at most 0.2 everywhere, the sun 1/(4 pi) = 0.08 more if all of it were
    // spread evenly; half of the sky is behind a cloud of some optical depths.
    CHECK(least > 0.03);
    CHECK(mean > 0.06);
    CHECK(mean < 0.3);
}
