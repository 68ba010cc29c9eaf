// SPDX-License-Identifier: Apache-2.0
// Paths that follow importance have the mean of paths that do not.
// in: clouds under sun and sky, both ways, under several seeds -> out: Welch tests of blocks.
// docs/importance.md, "Without bias". Significance of each scene: 6.8e-6, for all blocks together.
#include "lab/compare/welch.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

constexpr int kPasses = 8;

Scene importance_scene(bool importance, std::vector<std::string> more = {}) {
    std::vector<std::string> set = {"method.name=path",
                                    "path.samples_per_pixel=32",
                                    "output.layers=[\"radiance\",\"alpha\"]",
                                    "medium.0.albedo=1",
                                    "medium.0.extinction_per_m=0.05",
                                    importance ? "path.importance=true" : "path.importance=false"};
    set.insert(set.end(), more.begin(), more.end());
    return scene_from(kSmallCumulus, set);
}

BlockSums blocks_of(bool importance, const std::vector<std::string>& set) {
    BlockSums blocks;
    for (int pass = 0; pass < kPasses; ++pass) {
        Scene scene = importance_scene(importance, set);
        scene.seed = 100 * (importance ? 2 : 1) + pass;
        const Picture picture = render_one(scene);
        if (pass == 0) start_blocks(picture.image.width, picture.image.height, 4, blocks);
        REQUIRE(add_pass(picture.image, blocks));
        CHECK(picture.counter("terminated") == 0);
        CHECK(picture.counter("nan_samples") == 0);
    }
    return blocks;
}

void check_same_mean(const std::vector<std::string>& set) {
    std::string all;
    for (const std::string& text : set) all += text + " ";
    CAPTURE(all);
    WelchResult result;
    REQUIRE(compare_welch(blocks_of(true, set), blocks_of(false, set), kWelchSignificance, result));
    CAPTURE(result.largest_z);
    CHECK_FALSE(result.differ);
    for (int c = 0; c < 3; ++c) {
        CAPTURE(result.picture[c].z);
        CHECK(result.picture[c].detectable < 0.5);
        CHECK(result.chi_square_p[c] > kWelchSignificance);
    }
}

std::string why_without(const Picture& picture) {
    for (const LeftOut& l : picture.report.plan.left_out)
        if (l.what == "importance of paths") return l.why;
    return "";
}

std::string sun_at(int azimuth, int elevation) {
    return "sun.azimuth_deg=" + std::to_string(azimuth) +
           "|sun.elevation_deg=" + std::to_string(elevation);
}

/// The settings of a text that "|" parts.
std::vector<std::string> settings(const std::string& text) {
    std::vector<std::string> out{""};
    for (const char c : text) {
        if (c == '|')
            out.emplace_back();
        else
            out.back() += c;
    }
    return out;
}

const std::string kDark = "sky.radiance=[0,0,0]", kNoSun = "sun.irradiance=[0,0,0]";

}  // namespace

TEST_CASE("importance: suns aside, behind the camera and behind the cloud leave the mean") {
    check_same_mean({});
    check_same_mean(settings(sun_at(180, 10) + "|" + kDark));
    check_same_mean(settings(sun_at(0, 10) + "|" + kDark));
    check_same_mean(settings(sun_at(70, 85) + "|path.pixel=centre"));
}

TEST_CASE("importance: thin, thick and absorbing media leave the mean") {
    check_same_mean(settings("medium.0.extinction_per_m=0.001"));
    check_same_mean(settings("medium.0.extinction_per_m=0.4|" + sun_at(0, 20)));
    check_same_mean(settings("medium.0.albedo=0.9"));
    check_same_mean(settings("medium.0.albedo=0.9|" + sun_at(0, 10)));
    check_same_mean(settings("medium.0.albedo=0.3|" + kNoSun));
    check_same_mean(settings("medium.0.albedo=0"));
}

TEST_CASE("importance: phase functions from backward to sharply forward leave the mean") {
    for (const char* g : {"-0.5", "0", "0.6", "0.95"})
        check_same_mean(settings(std::string("path.guide=false|medium.0.phase.g=") + g));
}

TEST_CASE("importance: cameras within, periodic media and single voxels, too") {
    check_same_mean(settings("camera.position_m=[16,0,1024]|camera.target_m=[16,100,1000]"));
    check_same_mean(settings("medium.0.boundary=periodic"));
    check_same_mean(settings("camera.resolution=[1,1]|path.samples_per_pixel=512"));
    check_same_mean(
        settings("medium.0.density=uniform:box|medium.0.resolution=[1,1,1]|"
                 "medium.0.extinction_per_m=0.005"));
}

TEST_CASE("importance: in a white medium the sky alone is seen without noise") {
    const Picture picture = render_one(
        scene_from(kSmallCumulus,
                   {"method.name=path", "path.importance=true", "path.samples_per_pixel=2",
                    "medium.0.albedo=1", kNoSun, "ground.albedo=1", "camera.target_m=[0,0,6000]"}));
    for (int y = 0; y < picture.image.height; ++y)
        for (int x = 0; x < picture.image.width; ++x)
            CHECK(picture.at("B", x, y) == doctest::Approx(0.25).epsilon(1e-4));
}

TEST_CASE("importance: parts of the light are those of paths one by one") {
    const std::vector<std::string> set = {
        "output.layers=[\"radiance\",\"alpha\",\"cloud\",\"light\",\"order\",\"error\"]",
        "path.samples_per_pixel=256"};
    const Picture on = render_one(importance_scene(true, set));
    const Picture off = render_one(importance_scene(false, set));
    const double error = std::hypot(sum_of(on, "G").error, sum_of(off, "G").error);  // of all light
    for (const Channel& channel : off.image.channels) {
        if (channel.name.rfind("error", 0) == 0) continue;
        CAPTURE(channel.name);
        CHECK(std::fabs(sum_of(on, channel.name).value - sum_of(off, channel.name).value) <
              6 * error);
    }
}

TEST_CASE("importance: the same bits from any number of threads and instruction set") {
    std::string hash;
    for (const char* isa : {"scalar", ""})
        for (const int threads : {1, 2, 5}) {
            RenderOptions options;
            options.threads = threads;
            options.isa = isa;
            const Picture picture = render_one(importance_scene(true), options);
            if (hash.empty()) hash = picture.report.hash;
            CHECK(picture.report.hash == hash);
        }
}

TEST_CASE("importance: what it does not know has paths one by one, and the plan says why") {
    const std::pair<const char*, const char*> parts[] = {
        {"medium.0.albedo=[0.9,0.99,1]", "an albedo that differs by channel"},
        {"path.max_depth=2", "path.max_depth"},
        {"sun.angular_radius_deg=0.27", "sun.angular_radius_deg"},
        {"medium.0.phase={type=\"rayleigh\"}", "a phase function but Henyey-Greenstein's"}};
    for (const auto& [set, why] : parts) {
        CAPTURE(why);
        const Picture with = render_one(importance_scene(true, {set}));
        const Picture without = render_one(importance_scene(false, {set}));
        CHECK(with.report.hash == without.report.hash);
        CHECK(why_without(with) == why);
        CHECK(why_without(without) == "switched off");
    }
}

TEST_CASE("importance: by itself where the samples of a picture pay for its solution") {
    const auto says = [](const std::vector<std::string>& set) {
        Scene scene = importance_scene(true, set);
        scene.path.importance = ImportanceUse::kAuto;
        RenderOptions options;
        options.budget.samples = 1;
        return why_without(render_one(scene, options));
    };
    CHECK(says({}) == "too few samples to pay for its solution");
    CHECK(says({"path.samples_per_pixel=1000000"}) == "");
    CHECK(says({"path.target_error=0.01"}) == "");
    CHECK(says({"path.samples_per_pixel=1000000",
                "medium.0.phase={type=\"henyey-greenstein\", g=0.5}"}) ==
          "light is scattered too evenly");
}

TEST_CASE("importance: a part of a picture is traced as the whole is") {
    // 8 million samples of the whole, fewer of a part.
    Scene scene = importance_scene(true, {"path.samples_per_pixel=400000"});
    scene.path.importance = ImportanceUse::kAuto;
    RenderOptions options;
    options.budget.samples = 1;
    const Picture whole = render_one(scene, options);
    REQUIRE(why_without(whole) == "");
    const std::array<int, 2> size = scene.camera.resolution;
    REQUIRE(double(size[0]) * size[1] * 400000 > 8e6);
    scene.crop = {size[0] / 4, size[1] / 4, size[0] / 4 + 2, size[1] / 4 + 2};
    REQUIRE(4 * 400000 < 8e6);
    const Picture part = render_one(scene, options);
    CHECK(why_without(part) == "");
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x)
            CHECK(part.at("G", x, y) == whole.at("G", x + size[0] / 4, y + size[1] / 4));
}
