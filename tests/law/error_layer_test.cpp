// SPDX-License-Identifier: Apache-2.0
// The standard error that a picture carries is the spread that other seeds really show.
// in: one small cumulus under many seeds -> out: reported over empirical error, close to 1.
// docs/methods.md 3; docs/testing.md "Two stages".
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;

namespace {

const char* const kScene = R"(
camera = { position_m = [0, -2500, 520], target_m = [0, 0, 1000], fov_deg = 36, resolution = [32, 24] }
sun = { azimuth_deg = 65, elevation_deg = 38 }
sky = { radiance = [0.03, 0.05, 0.09] }
ground = { altitude_m = 0, albedo = 0.2 }
[[medium]]
density = "procedural:cumulus"
resolution = [40, 40, 28]
bounds_m = [[-800, -800, 600], [800, 800, 1700]]
extinction_per_m = 0.05
phase = { type = "henyey-greenstein", g = 0.85 }
[collectors]
photons = 96000
generations = 48
samples = 3000
[output]
layers = ["error"]
)";

/// Root of (mean reported variance / mean variance between seeds) over the cloud's pixels, or over
/// those of the ground.
double error_ratio(const std::vector<std::string>& extra, bool ground = false) {
    constexpr int kSeeds = 24;
    std::vector<double> sum, square, reported;
    std::vector<float> alpha;
    for (int seed = 1; seed <= kSeeds; ++seed) {
        std::vector<std::string> set = extra;
        set.push_back("seed=" + std::to_string(seed));
        const Picture p = render_one(scene_from(kScene, set), RenderOptions{});
        const Channel &g = *p.image.find("G"), &e = *p.image.find("error.G"),
                      &a = *p.image.find("A");
        const std::size_t pixels = g.pixels.size();
        sum.resize(pixels), square.resize(pixels), reported.resize(pixels), alpha.resize(pixels);
        for (std::size_t i = 0; i < pixels; ++i) {
            sum[i] += double(g.pixels[i]);
            square[i] += double(g.pixels[i]) * double(g.pixels[i]);
            reported[i] += double(e.pixels[i]) * double(e.pixels[i]) / kSeeds;
            alpha[i] = a.pixels[i];
        }
    }
    double between = 0, said = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        if ((alpha[i] <= 0.02f) != ground) continue;
        between += (square[i] - sum[i] * sum[i] / kSeeds) / (kSeeds - 1);
        said += reported[i];
    }
    return std::sqrt(said / between);
}

}  // namespace

TEST_CASE("the error layer is the spread between seeds") {
    for (const char* display : {"march", "billboards"}) {
        const double ratio = error_ratio({std::string("collectors.display=") + display});
        std::printf("%s: reported / empirical standard error %.3f\n", display, ratio);
        // 24 seeds of some 40 independent patches: the ratio itself is known to 1/sqrt(2*23*40),
        // 2.3 %; four times that.
        CHECK(std::fabs(ratio - 1) < 0.1);
    }
}

TEST_CASE("the error layer holds the noise of the light on the ground") {
    // From above: the light that the cloud scatters onto the ground around it, or keeps from it.
    const double ratio =
        error_ratio({"ground.albedo=0.5", "collectors.photons=19200",
                     "camera.position_m=[0,-1500,3500]", "camera.target_m=[0,0,600]"},
                    true);
    std::printf("ground: reported / empirical standard error %.3f\n", ratio);
    // As above; the map has more cells than the cloud has patches. Without the map the error of
    // bare ground would be 0.
    CHECK(std::fabs(ratio - 1) < 0.1);
}
