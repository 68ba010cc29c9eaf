// SPDX-License-Identifier: Apache-2.0
// The filter of pictures beside lamps: nearer to the truth than the samples that it is given.
// in: a small cloud by paths, under lamps -> out: pass or fail. docs/filter.md, "What it does"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

constexpr const char* kLit = R"(
[camera]
position_m = [0, -3000, 900]
target_m = [0, 0, 900]
fov_deg = 40
resolution = [48, 32]
[sun]
azimuth_deg = 200
elevation_deg = 30
irradiance = 0.2
[sky]
radiance = [0.005, 0.007, 0.011]
[method]
name = "path"
[path]
pixel = "centre"
[ground]
albedo = 0.3
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-800, -800, 500], [800, 800, 1400]]
resolution = [32, 32, 18]
extinction_per_m = 0.02
[[light]]
type = "point"
position_m = [-300, -1000, 900]
intensity = [1e6, 8e5, 6e5]
radius_m = 5
)";

Picture picture(int samples, const std::vector<std::string>& more) {
    std::vector<std::string> set = {"path.samples_per_pixel=" + std::to_string(samples)};
    set.insert(set.end(), more.begin(), more.end());
    return render_one(scene_from(kLit, set));
}

/// Squares of the difference in green, relative to the light and 0.01 more of it.
double square(const Picture& p, const Picture& truth) {
    double sum = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x) {
            const double t = double(truth.at("G", x, y)), d = double(p.at("G", x, y)) - t;
            sum += d * d / (t * t + 1e-4);
        }
    return sum / (32 * 48);
}

}  // namespace

TEST_CASE("filter: beside lamps a filtered picture is nearer to the truth than its samples") {
    const std::vector<std::string> filtered = {"filter.kind=regression"},
                                   dark = {"sun.irradiance=0"},
                                   behind = {"light.0.position_m=[500,1000,1000]"};
    for (const auto& place : {std::vector<std::string>{}, dark, behind}) {
        CAPTURE(place.empty() ? "" : place[0]);
        std::vector<std::string> seed = place;
        seed.push_back("seed=99");
        const Picture truth = picture(1500, seed);
        std::vector<std::string> both = place;
        both.insert(both.end(), filtered.begin(), filtered.end());
        for (const int samples : {4, 16}) {
            CAPTURE(samples);
            const double raw = square(picture(samples, place), truth);
            const double fit = square(picture(samples, both), truth);
            CHECK(fit < 0.6 * raw);
        }
    }
}
