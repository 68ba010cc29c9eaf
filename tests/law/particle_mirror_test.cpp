// SPDX-License-Identifier: Apache-2.0
// Method particles: what is mirrored has the mirrored picture.
// in: balls in mirrored pairs, a light and a camera in the mirror's plane -> out: left against
// right. docs/particles.md, "Light"; docs/testing.md, label law
#include <cmath>

#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;

namespace {

constexpr double kBalls[][5] = {{100, 20, 500, 150, 0.01},
                                {60, -80, 620, 90, 0.02},
                                {250, 50, 450, 120, 0.015},
                                {10, 90, 380, 70, 0.03}};

/// The balls and their images in the plane where coordinate `across` is 0, seen along the other.
Picture mirrored(int across, const std::string& lights, const std::vector<std::string>& overrides) {
    std::string rows = "x,y,z,radius,density\n";
    for (const auto& ball : kBalls)
        for (const double side : {1.0, -1.0}) {
            const double u = side * ball[0], v = ball[1];
            char row[96];
            (void)std::snprintf(row, sizeof row, "%.9g,%.9g,%.9g,%.9g,%.9g\n", across == 0 ? u : v,
                                across == 0 ? v : u, ball[2], ball[3], ball[4]);
            rows += row;
        }
    const test::TempFolder folder;
    folder.put("p.csv", rows);
    Scene scene = scene_from(
        std::string("[camera]\nposition_m = ") +
            (across == 0 ? "[0, -2000, 500]" : "[-2000, 0, 500]") +
            "\ntarget_m = [0, 0, 500]\nfov_deg = 30\nresolution = [48, 32]\n" + lights +
            "[[medium]]\ndensity = \"p.csv\"\nalbedo = 0.95\n"
            "phase = { type = \"henyey-greenstein\", g = 0.6 }\n[method]\nname = \"particles\"\n",
        overrides);
    scene.directory = folder.path("");
    return render_one(scene);
}

double largest_difference(const Picture& p) {
    double most = 0, difference = 0;
    for (int y = 0; y < p.image.height; ++y)
        for (int x = 0; x < p.image.width; ++x) {
            const double a = double(p.at("R", x, y)),
                         b = double(p.at("R", p.image.width - 1 - x, y));
            most = std::fmax(most, a);
            difference = std::fmax(difference, std::fabs(a - b));
        }
    REQUIRE(most > 0);
    return difference / most;
}

}  // namespace

TEST_CASE("particles: a mirrored cloud has a mirrored picture, whichever light shines") {
    // Depths are sums over balls in an order that mirrors change: some tens of float roundings.
    constexpr double kRounding = 2e-5;
    const char* const suns[2][4] = {
        {"[sun]\nazimuth_deg = 180\nelevation_deg = 35\n", "[sun]\nelevation_deg = 90\n",
         "[sun]\nazimuth_deg = 0\nelevation_deg = 5\n",
         "[[light]]\ntype = \"directional\"\nazimuth_deg = 180\nelevation_deg = 60\n"},
        {"[sun]\nazimuth_deg = 270\nelevation_deg = 35\n", "[sun]\nelevation_deg = 90\n",
         "[sun]\nazimuth_deg = 90\nelevation_deg = 5\n",
         "[[light]]\ntype = \"directional\"\nazimuth_deg = 270\nelevation_deg = 60\n"}};
    const char* const lamps[2][2] = {
        {"[[light]]\ntype = \"point\"\nposition_m = [0, -900, 800]\nintensity = 1e6\n",
         "[[light]]\ntype = \"spot\"\nposition_m = [0, 300, 1400]\ntarget_m = [0, 0, 500]\n"
         "cone_deg = 60\nintensity = 1e6\n"},
        {"[[light]]\ntype = \"point\"\nposition_m = [-900, 0, 800]\nintensity = 1e6\n",
         "[[light]]\ntype = \"spot\"\nposition_m = [300, 0, 1400]\ntarget_m = [0, 0, 500]\n"
         "cone_deg = 60\nintensity = 1e6\n"}};
    for (const int across : {0, 1}) {
        for (const char* light : suns[across])
            for (const char* kind :
                 {"particles.light=linear", "particles.light=centre", "particles.light=exact"}) {
                CAPTURE(light);
                CAPTURE(kind);
                CHECK(largest_difference(mirrored(across, light, {kind})) < kRounding);
            }
        for (const char* light : lamps[across]) {
            CAPTURE(light);
            CHECK(largest_difference(mirrored(across, light, {})) < kRounding);
        }
    }
    CHECK(largest_difference(mirrored(
              0, suns[0][0], {"particles.display=billboards", "particles.light_bias=0.3"})) <
          kRounding);
}
