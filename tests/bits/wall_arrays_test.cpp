// SPDX-License-Identifier: Apache-2.0
// The plan's bytes of nodes beside solids are those of their buffers.
// in: a cumulus with a plate in it, lit -> out: rows of the plan against what is held.
// docs/contributing.md, "Add an array"
#include "src/methods/march/march_method.h"
#include "src/methods/registry.h"
#include "tests/bits/ordinate_bytes.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace render_test;

TEST_CASE("arrays: what nodes beside solids hold is what the plan says") {
    const test::TempFolder folder;
    const std::string mesh = folder.put(
        "plate.obj", "v -400 -400 0\nv 400 -400 0\nv 400 400 90\nv -400 400 0\nf 1 2 3 4\n");
    const Scene scene = scene_from(std::string(kSmallCumulus) + "\n[[solid]]\nfile = \"" + mesh +
                                       "\"\nposition_m = [0, 0, 1000]\nalbedo = [0.2, 0.3, 0.4]\n",
                                   {"method.name=raymarch"});
    Report report;
    Context context;
    context.kernels = kernel_table(nullptr);
    context.threads = 2;
    context.report = &report;
    const MadeMethod made = raymarch_row().make({scene, {}});
    Scenery run;
    Plan plan;
    run.show(scene, scene);
    REQUIRE(open_method(raymarch_row(), made, context, true, nullptr, nullptr, run, plan));
    Planes* planes = nullptr;
    REQUIRE(made.method->render(context, run.view(0), {}, planes));
    std::map<std::string, std::uint64_t> held, planned;
    add_ordinates(static_cast<MarchMethod&>(*made.method).state().light.ordinates.nodes, held);
    CHECK(held["ordinates: ways that solids end"] > 0);
    for (const MemoryRow& row : plan.memory.rows())
        if (held.count(row.item) > 0) planned[row.item] += row.bytes;
    for (const auto& row : held) {
        CAPTURE(row.first);
        CHECK(row.second == planned[row.first]);
    }
}
