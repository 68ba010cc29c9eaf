// SPDX-License-Identifier: Apache-2.0
// Several media give equal bits from every instruction set and number of threads; media that hold
// nothing change none.
// in: three media of all kinds of phase function -> out: equal sums, ledgers and pictures.
// docs/determinism.md; docs/methods.md 2, "Several media".
#include "src/base/digest.h"
#include "tests/support/media_harness.h"
#include "tests/support/render_harness.h"

using namespace trace_test;

namespace {

Rig make_three(std::int32_t mode) {
    Rig rig;
    std::vector<Medium> media;
    media.push_back(make_box({0, 0, 0}, {120, 100, 80}, {12, 10, 8}, 0.05, 1));
    media.push_back(make_box({13, 21, -5}, {70, 60, 50}, {5, 6, 7}, 0.03, 2));
    media.push_back(make_box({40, -10, 30}, {90, 90, 90}, {3, 2, 4}, 0.02, 3));
    media[0].optics[0] = optics_of({0.9f, 0.99f, 1}, {kPhaseHg, 0.7f, 0, 1});
    media[0].channels = 3;
    media[1].optics[0] = optics_of({0.6f, 0.6f, 0.6f}, {kPhaseRayleigh, 0, 0, 1});
    media[2].optics[0] = optics_of({1, 1, 1}, {kPhaseTwoLobe, 0.9f, -0.5f, 0.3f});
    std::vector<MixBox> boxes;
    for (const Medium& m : media) boxes.push_back(box_of(m));
    REQUIRE(mix_media(media, plan_mix(boxes), 1, rig.medium));
    const std::size_t voxels = voxel_count(rig.medium.grid);
    REQUIRE(rig.collector_of_voxel.resize(voxels, "map"));
    for (std::size_t v = 0; v < voxels; ++v) rig.collector_of_voxel[v] = std::int32_t(v % 7);
    rig.collectors = 7;
    rig.deposit.mode = mode;
    rig.deposit.coefficients = mode == kDepositCamera ? 1 : 16;
    rig.deposit.camera[1] = -500;
    set_majorants(rig, 2);
    add_light(rig, beam_light(rig.medium, {0.48, 0.36, -0.8}));
    add_light(rig, diffuse_light(rig.medium, 0));
    return rig;
}

std::string shoot_digest(Rig& rig) {
    for (Light& l : rig.lighting.lights) l.photons = 5'000;
    const TraceInput in = input_of(rig, 42);
    TraceScratch scratch;
    PhotonSlot slot;
    REQUIRE(prepare_trace(in, scratch));
    REQUIRE(slot.sums.resize(slot_stride(in) * rig.lighting.lights.size(), "sums"));
    std::vector<TraceTally> tallies(rig.lighting.lights.size());
    REQUIRE(trace_generation(in, 0, scratch, slot, tallies));
    Digest d;
    d.integers(slot.sums.span());
    for (const TraceTally& t : tallies) {
        std::int64_t words[sizeof t / 8];
        std::memcpy(words, &t, sizeof t);
        d.integers({words, sizeof t / 8});
        for (std::size_t c = 0; c < 3; ++c) CHECK(balance(t.light, c) == 0);
    }
    return d.hex();
}

const char* const kText = R"(
seed = 5
camera = { position_m = [0, -300, 40], target_m = [0, 0, 0], fov_deg = 32, resolution = [33, 17] }
sun = { azimuth_deg = 60, elevation_deg = 40, irradiance = [1, 1, 1] }
sky = { radiance = [0.1, 0.2, 0.3] }
collectors = { photons = 20_000, generations = 2, samples = 500 }
[[medium]]
density = "uniform:sphere"
resolution = [16, 16, 16]
bounds_m = [[-50, -50, -50], [50, 50, 50]]
albedo = [0.9, 0.95, 1.0]
extinction_per_m = 0.03
phase = { type = "henyey-greenstein", g = 0.8 }
)";
const char* const kHaze = R"(
[[medium]]
density = "uniform:box"
bounds_m = [[-80, -80, -70], [80, 80, 60]]
extinction_per_m = 0.001
phase = { type = "rayleigh" }
)";

std::string hash_of(const std::string& text, const std::vector<std::string>& keys,
                    const RenderOptions& options = {}) {
    return render_test::render_one(render_test::scene_from(text, keys), options).report.hash;
}

}  // namespace

TEST_CASE("media: equal photons from every instruction set and number of threads") {
    for (std::int32_t mode : {kDepositIncident, kDepositOutgoing, kDepositCamera}) {
        CAPTURE(mode);
        Rig rig = make_three(mode);
        rig.kernels = kernel_table_at(0);
        const std::string scalar = shoot_digest(rig);
        for (int i = 1; const KernelTable* table = kernel_table_at(i); ++i) {
            CAPTURE(table->name);
            rig.kernels = table;
            rig.threads = i;
            CHECK(shoot_digest(rig) == scalar);
        }
        rig.medium.optics[2].phase.weight = 0.31f;  // the digest sees the third medium
        CHECK(shoot_digest(rig) != scalar);
    }
}

TEST_CASE("media: equal pictures from every instruction set and number of threads") {
    const std::vector<std::string> ways[] = {
        {}, {"collectors.display=billboards"}, {"collectors.closure=camera"}};
    for (const auto& keys : ways) {
        std::string first;
        for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i) {
            RenderOptions options;
            options.isa = table->name;
            options.threads = 1 + i;
            const std::string hash = hash_of(std::string(kText) + kHaze, keys, options);
            if (i == 0) first = hash;
            CHECK(hash == first);
        }
    }
}

TEST_CASE("media: one without extinction changes no bit, wherever it stands in the scene") {
    const std::string alone = hash_of(kText, {});
    CHECK(hash_of(std::string(kText) + kHaze, {"medium.1.extinction_per_m=0"}) == alone);
    const std::string text = kText;
    const std::size_t at = text.find("[[medium]]");
    const std::string turned = text.substr(0, at) + (kHaze + 1) + text.substr(at);
    CHECK(hash_of(turned, {"medium.0.extinction_per_m=0"}) == alone);
    CHECK(hash_of(std::string(kText) + kHaze, {}) != alone);

    // Without any extinction there is still a picture: the sky.
    const render_test::Picture dark = render_test::render_one(
        render_test::scene_from(std::string(kText) + kHaze,
                                {"medium.0.extinction_per_m=0", "medium.1.extinction_per_m=0"}));
    CHECK(dark.at("B", 16, 8) == 0.3f);
    CHECK(dark.at("A", 16, 8) == 0);
}

TEST_CASE("media: their number is limited, and a missing box is told by its own key") {
    std::string text = kText;
    for (int i = 0; i < 8; ++i) text += kHaze;
    const Scene nine = render_test::scene_from(text);
    const auto none = [](int, Image&, Report&) { return Status::ok(); };
    const Status many = render(nine, {}, none);
    CHECK(many.code == Code::kLimit);
    CHECK(many.message ==
          "test.toml: limits.media: needs 9, allowed: at most 8 (no switch raises it)");

    Scene scene = render_test::scene_from(std::string(kText) + kHaze);
    scene.media[1].box.has_bounds = false;
    const Status lost = render(scene, {}, none);
    CHECK(lost.code == Code::kBadInput);
    CHECK(lost.message.find("medium.1.bounds_m: left out") != std::string::npos);
}

TEST_CASE("media: the plan tells the common grid, and what one medium leaves out") {
    Report report;
    REQUIRE(plan_scene(render_test::scene_from(std::string(kText) + kHaze), {}, false, report));
    const auto needs = [&](const char* what) {
        return std::find(report.plan.needed.begin(), report.plan.needed.end(), what) !=
               report.plan.needed.end();
    };
    // The ball's voxels are 6.25 m and begin 30 m from the haze's face: neither fits.
    CHECK(needs(
        "media laid on one grid: 26x26x21 voxels of 6.154 x 6.154 x 6.19 m; medium 0 resampled"));
    Report one;
    REQUIRE(plan_scene(render_test::scene_from(kText), {}, false, one));
    bool left_out = false;
    for (const auto& l : one.plan.left_out)
        left_out |= l.what == "mixing of media" && l.why == "one medium";
    CHECK(left_out);
}
