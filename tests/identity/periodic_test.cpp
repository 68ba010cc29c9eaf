// SPDX-License-Identifier: Apache-2.0
// Periodic media give equal bits from every instruction set and number of threads.
// in: a periodic field over a ground, its pictures in both projections -> out: equal digests.
// docs/determinism.md; docs/methods.md 2, "Periodic media".
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

const char* const kText = R"(
seed = 5
camera = { position_m = [3, -130, 60], target_m = [0, 0, 20], fov_deg = 70, resolution = [33, 17] }
sun = { azimuth_deg = 60, elevation_deg = 20, irradiance = [1, 0.9, 0.8] }
sky = { radiance = [0.1, 0.2, 0.3] }
ground = { altitude_m = -60, albedo = 0.4 }
collectors = { photons = 20_000, generations = 4, samples = 500 }
[[medium]]
density = "uniform:sphere"
resolution = [13, 16, 11]
bounds_m = [[-50, -50, -50], [50, 50, 50]]
albedo = [0.9, 0.95, 1.0]
extinction_per_m = 0.03
phase = { type = "henyey-greenstein", g = 0.8 }
boundary = "periodic"
)";

}  // namespace

TEST_CASE("periodic: equal pictures from every instruction set and number of threads") {
    const std::vector<std::string> ways[] = {
        {},
        {"medium.0.albedo=1", "collectors.bands=6"},
        {"collectors.bands=3", "output.layers=[\"radiance\",\"alpha\",\"depth\",\"error\"]"},
        {"camera={position_m=[3,-130,60],target_m=[0,0,20],projection=\"orthographic\","
         "height_m=200,resolution=[33,17]}",
         "collectors.closure=lobe"}};
    for (const auto& keys : ways) {
        std::string first;
        const Scene scene = scene_from(kText, keys);
        for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i) {
            CAPTURE(table->name);
            RenderOptions options;
            options.isa = table->name;
            options.threads = 1 + i;
            const Picture picture = render_one(scene, options);
            for (const EnergyRow& row : picture.report.photons.energy) CHECK(row.sides == 0);
            if (i == 0) first = picture.report.hash;
            CHECK(picture.report.hash == first);
        }
        // The picture knows the boundary.
        std::vector<std::string> open = keys;
        open.push_back("medium.0.boundary=open");
        CHECK(render_one(scene_from(kText, open)).report.hash != first);
    }
}
