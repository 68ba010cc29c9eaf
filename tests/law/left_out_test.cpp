// SPDX-License-Identifier: Apache-2.0
// What the plan leaves out is not run: counters and array sizes are 0, and above 0 where needed.
// in: a small scene with and without each part -> out: pass or fail.
// docs/report.md, "Left out".
#include <doctest/doctest.h>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

const char* const kScene = R"(
seed = 3
[camera]
position_m = [0, -300, 60]
target_m = [0, 0, 60]
resolution = [24, 16]
[sun]
elevation_deg = 40
[sky]
radiance = [0.1, 0.2, 0.3]
[ground]
altitude_m = 0
[[medium]]
density = "uniform:sphere"
resolution = [12, 12, 12]
bounds_m = [[-50, -50, 10], [50, 50, 110]]
extinction_per_m = 0.05
albedo = 0.9
[collectors]
photons = 4000
generations = 4
samples = 400
[output]
layers = ["radiance", "alpha", "depth", "error"]
)";

std::string without(std::string text, const std::string& part, const std::string& instead = "") {
    const std::size_t at = text.find(part);
    REQUIRE(at != std::string::npos);
    return text.replace(at, part.size(), instead);
}

Picture rendered(const std::string& text) { return render_one(scene_from(text)); }

std::uint64_t executed(const Picture& picture, const char* name) {
    for (const auto& count : picture.report.executed)
        if (count.first == name) return count.second;
    FAIL("nothing executed of this name");
    return 0;
}

std::uint64_t bytes(const Picture& picture, const char* item) {
    std::uint64_t sum = 0;
    for (const MemoryRow& row : picture.report.plan.memory.rows())
        if (row.item == item) sum += row.bytes;
    return sum;
}

bool left_out(const Picture& picture, const char* what) {
    for (const LeftOut& part : picture.report.plan.left_out)
        if (part.what == what) return !part.why.empty();
    return false;
}

bool has_light(const Picture& picture, const char* name) {
    for (const EnergyRow& row : picture.report.photons.energy)
        if (row.light == name) return true;
    return false;
}

}  // namespace

TEST_CASE("left out: absorption with albedo 1, and nothing without a part that needs it") {
    const Picture all = rendered(kScene);
    CHECK(executed(all, "absorption_tests") > 0);
    CHECK(executed(all, "absorption_tests") == all.report.events.scatterings);
    CHECK_FALSE(left_out(all, "absorption"));

    const Picture white = rendered(without(kScene, "albedo = 0.9", "albedo = 1"));
    CHECK(white.report.events.scatterings > 0);
    CHECK(executed(white, "absorption_tests") == 0);
    CHECK(left_out(white, "absorption"));
    for (const EnergyRow& row : white.report.photons.energy) CHECK(row.absorbed == 0);
}

TEST_CASE("left out: bounces, their map and depth tests without a ground") {
    const Picture all = rendered(kScene);
    CHECK(executed(all, "ground_bounces") > 0);
    CHECK(executed(all, "depth_tests") == 24 * 16);
    CHECK(bytes(all, "ground map") > 0);

    const Picture none = rendered(without(kScene, "[ground]\naltitude_m = 0\n"));
    CHECK(executed(none, "ground_bounces") == 0);
    CHECK(executed(none, "depth_tests") == 0);
    CHECK(bytes(none, "ground map") == 0);
    CHECK(bytes(none, "picture planes") == bytes(all, "picture planes") - 4 * 24 * 16);
    CHECK(left_out(none, "ground bounce"));
    CHECK(left_out(none, "depth test"));
    CHECK_FALSE(has_light(none, "ground"));
}

TEST_CASE("left out: mixing, its parts and shares with one medium") {
    const Picture two = rendered(std::string(kScene) +
                                 "\n[[medium]]\ndensity = \"uniform:box\"\n"
                                 "bounds_m = [[-50, -50, 60], [50, 50, 110]]\n"
                                 "resolution = [4, 4, 4]\nextinction_per_m = 0.001\n");
    CHECK(executed(two, "parts_stored") > 0);
    CHECK(bytes(two, "parts of the media") == 4 * executed(two, "parts_stored"));
    CHECK(bytes(two, "shares of the media") > 0);

    const Picture one = rendered(kScene);
    CHECK(executed(one, "parts_stored") == 0);
    CHECK(bytes(one, "parts of the media") == 0);
    CHECK(bytes(one, "shares of the media") == 0);
    CHECK(left_out(one, "mixing of media"));
}

TEST_CASE("left out: sky photons under a constant sky with albedo 1") {
    CHECK(has_light(rendered(kScene), "sky"));
    const Picture white = rendered(without(kScene, "albedo = 0.9", "albedo = 1"));
    CHECK_FALSE(has_light(white, "sky"));
    CHECK(left_out(white, "sky photons"));
    CHECK(left_out(white, "sky map"));
    CHECK(bytes(white, "sky map") == 0);
    CHECK(has_light(rendered(without(kScene, "albedo = 0.9", "albedo = [1, 1, 0.9]")), "sky"));
}

TEST_CASE("left out: two colours of three where the medium is grey") {
    const Picture grey = rendered(kScene);
    const Picture coloured = rendered(without(kScene, "albedo = 0.9", "albedo = [0.9, 0.8, 0.7]"));
    CHECK(executed(coloured, "coefficients") == 3 * executed(grey, "coefficients"));
    CHECK(bytes(coloured, "photon map") == 3 * bytes(grey, "photon map"));
    CHECK(left_out(grey, "coefficients per colour channel"));
    CHECK_FALSE(left_out(coloured, "coefficients per colour channel"));
}

TEST_CASE("left out: batches without the error layer, depths without the depth layer") {
    const Picture all = rendered(kScene);
    CHECK(executed(all, "batches") == 4);
    CHECK(executed(all, "depths_stored") == 24 * 16);

    const Picture plain =
        rendered(without(kScene, R"("radiance", "alpha", "depth", "error")", R"("radiance")"));
    CHECK(executed(plain, "batches") == 0);
    CHECK(executed(plain, "depths_stored") == 0);
    CHECK(bytes(all, "photon map") == 4 * bytes(plain, "photon map"));
    CHECK(bytes(all, "collector colours") == 5 * bytes(plain, "collector colours"));
    CHECK(left_out(plain, "batches and second moments"));
    CHECK(left_out(plain, "depth of the medium"));
    // What is left out changes nothing that is left in.
    CHECK(plain.report.hash == all.report.hash);
}

TEST_CASE("left out: billboards keep no depths either, and the march no billboards") {
    const std::string text =
        without(kScene, "samples = 400", "samples = 400\ndisplay = \"billboards\"");
    const Picture all = rendered(text);
    CHECK(bytes(all, "source grid") == 0);
    CHECK(bytes(all, "billboards") > 0);
    const Picture plain =
        rendered(without(text, R"("radiance", "alpha", "depth", "error")", R"("radiance")"));
    CHECK(executed(plain, "depths_stored") == 0);
    CHECK(plain.report.hash == all.report.hash);
    CHECK(bytes(rendered(kScene), "billboards") == 0);
}

TEST_CASE("left out: digests of stages where no report asks for them, in every frame") {
    const std::string text = without(kScene, "[collectors]", R"([animation]
frames = 3
camera_orbit_deg = [0, 20]
sun_elevation_deg = [30, 40]
[path]
samples_per_pixel = 1
[photon_grid]
photons = 4000
generations = 4
[collectors])");
    for (const char* method : {"collectors", "photon-grid", "raymarch", "path"}) {
        CAPTURE(method);
        const Scene scene = scene_from(without(text, R"(, "error")", ""),
                                       {"method.name=\"" + std::string(method) + "\""});
        // Each frame's hash, and how many digests its report has besides.
        const auto frames = [&](bool digests) {
            std::vector<std::pair<std::string, std::size_t>> out;
            RenderOptions options;
            options.digests = digests;
            options.last_frame = 2;
            const Status status = render(scene, options, [&](int, Image&, Report& report) {
                REQUIRE(!report.digests.empty());
                CHECK(report.digests.back() == std::make_pair(std::string("image"), report.hash));
                out.emplace_back(report.hash, report.digests.size() - 1);
                return Status::ok();
            });
            REQUIRE_MESSAGE(status, status.message);
            return out;
        };
        const auto all = frames(true), plain = frames(false);
        REQUIRE(all.size() == 3);
        REQUIRE(plain.size() == 3);
        for (std::size_t f = 0; f < 3; ++f) {
            CHECK(all[f].second >= 2);
            CHECK(plain[f].second == 0);
            CHECK(plain[f].first == all[f].first);
        }
    }
}
