// SPDX-License-Identifier: Apache-2.0
// Whole pictures whose photons are added up by each thread alone or by all to one set of sums.
// in: a small scene with its error layer -> out: equal digests of every stage.
// docs/collectors.md, "Accumulation"; photons_test.cpp has the sums alone.
#include "src/base/digest.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

std::string digests_of(const Picture& picture) {
    std::string all = picture.report.hash;
    for (const auto& digest : picture.report.digests)
        all += "\n" + digest.first + " " + digest.second;
    Digest error;
    for (const char* name : {"error.R", "error.G", "error.B"}) {
        const Channel* channel = picture.image.find(name);
        REQUIRE(channel != nullptr);
        error.floats({channel->pixels.data(), channel->pixels.size()});
    }
    return all + "\n" + error.hex();
}

}  // namespace

TEST_CASE("identity: a picture and its errors, sums private, shared or of one thread") {
    RenderOptions options;
    options.threads = 1;
    const Picture alone = render_one(scene_from(kSmallCumulus), options);
    CHECK(alone.report.plan.accumulation.kind == "direct");
    for (const char* way : {"private", "shared"})
        for (int threads : {2, 5}) {
            CAPTURE(way);
            CAPTURE(threads);
            options.threads = threads;
            const Picture picture = render_one(
                scene_from(kSmallCumulus, {std::string("collectors.accumulation=") + way}),
                options);
            CHECK(picture.report.plan.accumulation.kind == way);
            CHECK(digests_of(picture) == digests_of(alone));
        }
}

TEST_CASE("identity: a limit of memory makes threads share their sums, with the same bits") {
    RenderOptions options;
    options.threads = 48;
    const Picture roomy = render_one(scene_from(kSmallCumulus), options);
    CHECK(roomy.report.plan.accumulation.kind == "private");
    // With the leaves known beforehand the bounds of the plan let so little memory pass.
    options.limits[LimitId::kLeaves] = roomy.report.prepared.leaves;
    options.limits[LimitId::kMemory] = roomy.report.plan.memory.peak() - 1;
    const Picture tight = render_one(scene_from(kSmallCumulus), options);
    CHECK(tight.report.plan.accumulation.kind == "shared");
    CHECK(tight.report.plan.memory.peak() < roomy.report.plan.memory.peak());
    CHECK(digests_of(tight) == digests_of(roomy));
}
