// SPDX-License-Identifier: Apache-2.0
// Views give the same bits from every number of threads and every instruction set.
// in: a small cumulus, each view -> out: one hash per view.
// docs/how-it-works.md; docs/determinism.md
#include "tests/render_harness.h"

using namespace render_test;

namespace {

const char* const kText = R"(
seed = 4
[camera]
position_m = [0, -3000, 600]
target_m = [0, 0, 1100]
fov_deg = 34
resolution = [70, 40]
[sun]
azimuth_deg = 120
elevation_deg = 35
[sky]
radiance = [0.0625, 0.125, 0.25]
[ground]
altitude_m = 0
albedo = 0.25
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-768, -768, 512], [768, 768, 1536]]
resolution = [24, 24, 16]
extinction_per_m = 0.0625
albedo = [0.9, 0.99, 1.0]
phase = { type = "henyey-greenstein", g = 0.85 }
[collectors]
photons = 12_000
generations = 4
samples = 1_000
)";

std::string hash_of(const Scene& scene, const RenderOptions& options) {
    std::string hash;
    const Status status = render(scene, options, [&](int, Image&, Report& report) {
        hash = report.hash;
        return Status::ok();
    });
    REQUIRE_MESSAGE(status, status.message);
    return hash;
}

}  // namespace

TEST_CASE("views: threads and instruction sets give one picture") {
    const Scene scene = scene_from(kText);
    std::vector<std::string> hashes;
    for (const char* view : {"density-slice", "gradient-slice", "gradient", "samples", "tree",
                             "leaf-density", "collectors", "photons", "illumination"}) {
        CAPTURE(view);
        RenderOptions options;
        options.show = view;
        options.threads = 1;
        const std::string hash = hash_of(scene, options);
        CHECK(hash.size() == 16);
        for (const std::string& other : hashes) CHECK(other != hash);
        hashes.push_back(hash);
        for (int threads : {2, 3, 8}) {
            options.threads = threads;
            CHECK(hash_of(scene, options) == hash);
        }
        for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i) {
            options.isa = table->name;
            CHECK(hash_of(scene, options) == hash);
        }
    }
}
