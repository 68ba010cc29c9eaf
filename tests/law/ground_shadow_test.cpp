// SPDX-License-Identifier: Apache-2.0
// The medium's shadow on the ground from nodes, against the rays of its layer; where there are
// none. in: a small cumulus over a ground under suns of all heights -> out: bounded differences.
// docs/collectors.md, "Light that needs no photon"
#include <algorithm>
#include <cmath>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

std::vector<std::string> seen_from_above(const std::string& sun_deg) {
    return {"method.name = \"raymarch\"",
            "camera.resolution = [240, 160]",
            "camera.position_m = [0, -2600, 2400]",
            "camera.target_m = [0, 300, 0]",
            "sun.elevation_deg = " + sun_deg,
            "sky.radiance = [0, 0, 0]",
            "raymarch.scattering = \"single\"",
            "output.layers = [\"radiance\", \"alpha\", \"shadow\"]"};
}

}  // namespace

TEST_CASE("ground shadow: nodes a cell apart are as each pixel's own ray") {
    for (const char* sun : {"3", "25", "60", "89.9", "90"}) {
        CAPTURE(sun);
        const Picture p = render_one(scene_from(kSmallCumulus, seen_from_above(sun)));
        const auto clear = [&](int x, int y) { return p.at("A", x, y) == 0; };
        double bright = 0;
        for (int y = 0; y < 160; ++y)
            for (int x = 0; x < 240; ++x)
                if (clear(x, y) && p.at("shadow", x, y) == 0)
                    bright = std::max(bright, double(p.at("G", x, y)));
        double sum = 0, most = 0;
        int count = 0, dark = 0;
        for (int y = 0; y < 160; ++y)
            for (int x = 0; x < 240; ++x) {
                if (!clear(x, y)) continue;
                // Under a sky of no light the ground is as bright as the sun leaves it.
                const double shadow = double(p.at("shadow", x, y));
                const double off = std::abs(double(p.at("G", x, y)) / bright - (1 - shadow));
                ++count;
                dark += shadow > 0.5 ? 1 : 0;
                sum += off;
                most = std::max(most, off);
            }
        MESSAGE(sun << " deg: mean " << sum / count << ", largest " << most << ", dark " << dark);
        REQUIRE(count > 10000);
        if (std::string(sun) == "3") {
            CHECK(most < 1e-5);  // too long a shadow: pixels look for themselves
            continue;
        }
        REQUIRE(dark > 500);
        CHECK(sum / count < 0.004);
        CHECK(most < 0.4);  // e^-tau of a cell of 64 m at 0.06 per m may begin between two nodes
        CHECK(most > 1e-5);
    }
}
