// SPDX-License-Identifier: Apache-2.0
// Views give the same bits from every number of threads and every instruction set.
// in: a small cumulus, each view -> out: one hash per view.
// docs/how-it-works.md; docs/determinism.md
#include "lab/views/view_list.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

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
    const Scene scene = scene_from(
        kSmallCumulus, {"camera.position_m=[0, -3000, 600]", "camera.target_m=[0, 0, 1100]",
                        "camera.fov_deg=34", "camera.resolution=[70, 40]"});
    std::vector<std::string> hashes;
    for (const char* view : {"density-slice", "gradient-slice", "gradient", "samples", "tree",
                             "leaf-density", "collectors", "photons", "illumination"}) {
        CAPTURE(view);
        RenderOptions options;
        options.show = view;
        options.find_view = find_view;
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
