// SPDX-License-Identifier: Apache-2.0
// The error layer of a filtered picture: what two seeds really differ by, and its corners.
// in: small scenes by paths -> out: pass or fail. docs/filter.md, "The error of a filtered picture"
#include <cmath>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

constexpr const char* kCloud = R"(
[camera]
position_m = [0, -3200, 900]
target_m = [0, 0, 700]
fov_deg = 30
resolution = [96, 64]
[sun]
azimuth_deg = 60
elevation_deg = 30
[sky]
radiance = [0.03, 0.05, 0.1]
[method]
name = "path"
[filter]
kind = "regression"
[output]
layers = ["error"]
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-600, -600, 400], [600, 600, 1200]]
resolution = [32, 32, 22]
extinction_per_m = 0.05
phase = { type = "henyey-greenstein", g = 0.85 }
)";

constexpr int kSeeds = 12;

Picture picture(int seed, int samples, const std::vector<std::string>& more = {}) {
    std::vector<std::string> set = {"seed=" + std::to_string(seed),
                                    "path.samples_per_pixel=" + std::to_string(samples)};
    set.insert(set.end(), more.begin(), more.end());
    return render_one(scene_from(kCloud, set));
}

}  // namespace

TEST_CASE("filter error: its squares are those of what seeds differ by") {
    const char* ground = "ground.altitude_m=0";
    for (const bool grounded : {false, true})
        for (const int samples : {1, 4}) {
            CAPTURE(grounded);
            CAPTURE(samples);
            std::vector<std::string> more;
            if (grounded) more.push_back(ground);
            std::vector<Picture> all;
            for (int seed = 1; seed <= kSeeds; ++seed) all.push_back(picture(seed, samples, more));
            double told = 0, seen = 0;
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 96; ++x) {
                    double mean = 0, square = 0;
                    for (const Picture& p : all) {
                        const double e = double(p.at("error.G", x, y));
                        CHECK(e >= 0);
                        told += e * e / kSeeds;
                        mean += double(p.at("G", x, y)) / kSeeds;
                    }
                    for (const Picture& p : all)
                        square += std::pow(double(p.at("G", x, y)) - mean, 2) / (kSeeds - 1);
                    seen += square;
                }
            CAPTURE(told / seen);
            // Sixteen seeds have 1.0 with one sample, 1.5 with four; in seven scenes 0.5 to 2.
            CHECK(told < 2.2 * seen);
            CHECK(told > 0.5 * seen);
        }
}

TEST_CASE("filter error: the picture is the one without it, small pictures have one, too") {
    const Picture with = picture(3, 2), without = picture(3, 2, {"output.layers=[]"});
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 96; ++x) CHECK(with.at("G", x, y) == without.at("G", x, y));
    for (const char* size : {"[1, 1]", "[2, 1]", "[1, 70]", "[9, 3]"}) {
        const Picture p = picture(3, 1, {std::string("camera.resolution=") + size});
        for (const float e : p.image.find("error.R")->pixels.span()) CHECK(std::isfinite(e));
    }
    // Sky alone has no noise, and no error.
    CHECK(with.at("error.G", 0, 0) == 0.0f);
}
