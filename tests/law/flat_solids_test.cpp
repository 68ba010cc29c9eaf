// SPDX-License-Identifier: Apache-2.0
// Solids of which no triangle has an area: there is nothing to meet, and pictures are those
// without. in: a mesh of lines and points -> out: pictures of every method with it and without it.
// docs/solids.md, "Meshes"
#include <cmath>

#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;

namespace {

constexpr const char* kFlat =
    "v 0 0 500\nv 1 0 500\nv 2 0 500\nv 2 0 500\nf 1 2 3\nf 3 4 3\nf 1 1 1\n";

std::string scene_text(const char* density, const char* lights, bool solid) {
    std::string text =
        "[camera]\nposition_m = [0, -2000, 500]\ntarget_m = [0, 0, 500]\nresolution = [8, 6]\n"
        "[ground]\n[[medium]]\n" +
        std::string(density) + lights;
    if (solid) text += "[[solid]]\nfile = \"flat.obj\"\n[[solid]]\nfile = \"flat.obj\"\n";
    return text;
}

constexpr const char* kBall =
    "density = \"uniform:sphere\"\nextinction_per_m = 0.01\nresolution = [8, 8, 8]\n"
    "bounds_m = [[-200, -200, 300], [200, 200, 700]]\n";
constexpr const char* kBalls = "density = \"p.csv\"\n";

}  // namespace

TEST_CASE("solids without any area: every method draws as without them") {
    const test::TempFolder folder;
    folder.put("flat.obj", kFlat);
    folder.put("p.csv", "x,y,z,radius,density\n-100,0,500,180,0.01\n50,30,520,80,0.02\n");
    const char* const kSun = "[sun]\nelevation_deg = 40\n";
    const char* const kLamps =
        "[sun]\n[sky]\nradiance = 0.1\n"
        "[[light]]\ntype = \"point\"\nposition_m = [0, -600, 900]\nintensity = 1e5\n"
        "[[light]]\ntype = \"point\"\nposition_m = [300, -600, 900]\nintensity = 1e5\n"
        "radius_m = 20\n";
    const struct {
        const char *density, *lights;
        std::vector<std::string> set;
        double tolerance;  ///< of the sum: float roundings; photons and paths draw other numbers
    } rows[] = {
        {kBalls, kSun, {"method.name=particles"}, 1e-6},
        {kBalls, kSun, {"method.name=particles", "particles.display=billboards"}, 1e-6},
        {kBalls, kSun, {"method.name=particles", "particles.light=linear"}, 1e-6},
        {kBalls, kLamps, {"method.name=particles", "particles.solid_shadow=0.5"}, 1e-6},
        {kBall, kSun, {"method.name=raymarch"}, 1e-6},
        {kBall, kSun, {"method.name=optical-depth"}, 1e-6},
        {kBall,
         kSun,
         {"method.name=collectors", "collectors.photons=4000", "collectors.samples=200"},
         0.05},
        {kBall, kSun, {"method.name=photon-grid", "photon_grid.photons=4000"}, 0.05},
        {kBall, kSun, {"method.name=path", "path.samples_per_pixel=64"}, 0.05},
    };
    for (const auto& row : rows) {
        CAPTURE(row.set.front());
        PixelSum sums[2];
        for (const bool solid : {false, true}) {
            Scene scene = scene_from(scene_text(row.density, row.lights, solid), row.set);
            scene.directory = folder.path("");
            const Picture p = render_one(scene);
            sums[solid ? 1 : 0] = sum_of(p, "R");
            if (solid) CHECK(p.counter("degenerate_triangles") == 6);
        }
        REQUIRE(sums[0].value > 0);
        CHECK(std::fabs(sums[1].value / sums[0].value - 1) <= row.tolerance);
    }
}
