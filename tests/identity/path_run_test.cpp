// SPDX-License-Identifier: Apache-2.0
// A path traced picture depends on its number of samples alone: not on passes, breaks, threads.
// in: small scenes, interrupted at chosen moments -> out: equal digests.
// docs/determinism.md; docs/program.md, "Budgets of a path tracing"
#include "src/session/stop_rule.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

Scene path_scene(const std::string& samples, const std::vector<std::string>& more = {}) {
    std::vector<std::string> set = {"method.name=path", "path.samples_per_pixel=" + samples,
                                    "output.layers=[\"error\",\"light\",\"order\",\"cloud\"]"};
    set.insert(set.end(), more.begin(), more.end());
    return scene_from(kSmallCumulus, set);
}

/// Asks for an end at the n-th question.
std::function<bool()> stop_at(int n) {
    auto asked = std::make_shared<int>(0);
    return [asked, n] { return ++*asked >= n; };
}

std::vector<Picture> render_frames(const Scene& scene, int first, int last) {
    RenderOptions options;
    options.first_frame = first;
    options.last_frame = last;
    std::vector<Picture> all;
    const Status status = render(scene, options, [&](int, Image& image, Report& report) {
        all.emplace_back();
        all.back().image = std::move(image);
        all.back().report = report;
        return Status::ok();
    });
    REQUIRE_MESSAGE(status, status.message);
    return all;
}

std::string film_of(const Picture& picture) {
    for (const auto& digest : picture.report.digests)
        if (digest.first == "film") return digest.second;
    FAIL("no film");
    return "";
}

}  // namespace

TEST_CASE("path: interrupted twice and resumed, a film has the bits of one that was not") {
    const test::TempFolder folder;
    const Picture whole = render_one(path_scene("40"));
    CHECK(whole.report.paths.samples_per_pixel == 40);
    CHECK_FALSE(whole.report.interrupted);
    RenderOptions options;
    options.budget.state = folder.path("film.state");
    std::uint64_t samples = 0;
    for (int stop : {2, 4}) {
        options.interrupted = stop_at(stop);
        options.threads = stop - 1;
        const Picture part = render_one(path_scene("40"), options);
        CHECK(part.report.interrupted);
        CHECK(part.report.paths.samples_per_pixel > samples);
        CHECK(part.report.paths.samples_per_pixel < 40);
        CHECK(part.report.paths.traced == 24 * 14 * part.report.paths.samples_per_pixel);
        samples = part.report.paths.samples_per_pixel;
        const Picture at_once = render_one(path_scene(std::to_string(samples)));
        CHECK(film_of(part) == film_of(at_once));
        CHECK(part.report.hash == at_once.report.hash);
        CHECK(part.report.errors.mean_relative == at_once.report.errors.mean_relative);
    }
    options.interrupted = nullptr;
    options.isa = "scalar";
    const Picture resumed = render_one(path_scene("40"), options);
    CHECK(film_of(resumed) == film_of(whole));
    CHECK(resumed.report.hash == whole.report.hash);
    CHECK(resumed.report.events.scatterings == whole.report.events.scatterings);
    CHECK(resumed.report.paths.shadow_rays == whole.report.paths.shadow_rays);
    CHECK(resumed.report.paths.earlier == 24 * 14 * samples);
}

TEST_CASE("path: an error ends where it would have ended without a break") {
    const test::TempFolder folder;
    RenderOptions options;
    options.budget.error = 0.06;
    const Picture whole = render_one(path_scene("1"), options);
    CHECK(whole.report.errors.mean_relative <= 0.06);
    CHECK(whole.report.paths.samples_per_pixel > 16);
    options.budget.state = folder.path("film.state");
    options.interrupted = stop_at(3);
    const Picture part = render_one(path_scene("1"), options);
    CHECK(part.report.interrupted);
    options.interrupted = nullptr;
    for (int again = 0; again < 2; ++again) {
        const Picture resumed = render_one(path_scene("1"), options);
        CHECK(resumed.report.paths.samples_per_pixel == whole.report.paths.samples_per_pixel);
        CHECK(film_of(resumed) == film_of(whole));
    }
}

TEST_CASE("path: interrupted before the first sample there is no picture") {
    RenderOptions options;
    options.interrupted = [] { return true; };
    const Status status = render(path_scene("4"), options, [](int, Image&, Report&) {
        FAIL("a picture of nothing");
        return Status::ok();
    });
    CHECK(status.code == Code::kCheckFailed);
    CHECK(status.message.find("interrupted before the first sample") != std::string::npos);
}

TEST_CASE("path: a frame is that of its own sun, camera and seed, rendered alone or not") {
    const std::vector<std::string> moves = {"animation.frames=3",
                                            "animation.sun_elevation_deg=[40,10]"};
    const Scene scene = path_scene("6", moves);
    const std::vector<Picture> all = render_frames(scene, 0, 2);
    REQUIRE(all.size() == 3);
    CHECK(film_of(render_frames(scene, 2, 2)[0]) == film_of(all[2]));
    CHECK(all[2].report.paths.traced == 3 * all[0].report.paths.traced);
    // The scene's seed is 4; frame 1 has that of a still with seed 5.
    CHECK(film_of(render_one(path_scene("6", {"sun.elevation_deg=25", "seed=5"}))) ==
          film_of(all[1]));
    CHECK(film_of(all[0]) != film_of(all[1]));

    const test::TempFolder folder;
    RenderOptions options;
    options.last_frame = 2;
    options.budget.state = folder.path("film.state");
    options.interrupted = stop_at(5);
    int frames = 0;
    bool interrupted = false;
    REQUIRE(render(scene, options, [&](int, Image&, Report& report) {
        ++frames;
        interrupted = report.interrupted;
        return Status::ok();
    }));
    CHECK(interrupted);
    CHECK(frames < 3);
    options.interrupted = nullptr;
    std::vector<std::string> films;
    REQUIRE(render(scene, options, [&](int, Image&, Report& report) {
        films.push_back(report.digests[2].second);
        return Status::ok();
    }));
    REQUIRE(films.size() == 3);
    for (std::size_t f = 0; f < 3; ++f) CHECK(films[f] == film_of(all[f]));
}

TEST_CASE("collectors: interrupted, the picture is that of the generations there are") {
    const std::vector<std::string> layers = {"output.layers=[\"error\"]"};
    RenderOptions options;
    options.interrupted = stop_at(4);
    const Picture part = render_one(scene_from(kSmallCumulus, layers), options);
    CHECK(part.report.interrupted);
    CHECK(part.report.photons.generations == 3);
    REQUIRE(part.image.find("error.R") != nullptr);
    // Four generations of 3000 photons each, and three of the same.
    const Picture whole = render_one(scene_from(
        kSmallCumulus, {layers[0], "collectors.photons=9000", "collectors.generations=3"}));
    CHECK(whole.report.photons.traced == part.report.photons.traced);
    CHECK(whole.report.hash == part.report.hash);
    CHECK(whole.report.errors.mean_relative == part.report.errors.mean_relative);
    options.interrupted = [] { return true; };
    CHECK(render(scene_from(kSmallCumulus, layers), options, [](int, Image&, Report&) {
              return Status::ok();
          }).code == Code::kCheckFailed);
}

TEST_CASE(
    "path: passes stay within their rule, and the samples at which the error is looked at rise") {
    LightGoal goal;
    goal.most = 100;
    goal.early = 0.5;
    const StopRule samples(goal);
    std::uint64_t count = 0;
    for (int i = 0; i < 40; ++i) {
        const std::uint64_t next = samples.next_look(count);
        REQUIRE(next > count);
        CHECK(samples.is_look(next));
        CHECK_FALSE(samples.is_look(next + 1));
        if (count > 0) CHECK(next <= count + count / 4);
        count = next;
    }
    const auto pass = [](const LightGoal& of, std::uint64_t held, LightPass last, double spent_s) {
        LightUnits light;
        light.held = held;
        light.in_passes = true;
        return StopRule(of).next(light, spent_s, last);
    };
    CHECK(pass(goal, 0, {}, 0) == 1);
    CHECK(pass(goal, 1, {1, 1e-6}, 0) == 2);
    CHECK(pass(goal, 1, {8, 0.25}, 0) == 16);
    CHECK(pass(goal, 1, {8, 4}, 0) == 1);
    CHECK(pass(goal, 99, {64, 1e-6}, 0) == 1);
    goal.error = 0.1;
    CHECK(pass(goal, 16, {64, 1e-6}, 0) == 4);
    goal.error = 0;
    goal.seconds = 1;
    CHECK(pass(goal, 16, {10, 0.1}, 0.95) == 5);
    // Half a sample's time is left, and no sample at all is no picture.
    CHECK(pass(goal, 16, {10, 1}, 0.96) == 0);
    CHECK(pass(goal, 0, {}, 2) == 1);
}

TEST_CASE("photons double until their error is met, one generation at a time") {
    LightGoal goal;
    goal.most = 20;
    goal.error = 0.1;
    goal.first_look = 4;
    goal.doubles = true;
    const StopRule rule(goal);
    LightUnits light;
    for (light.held = 0; !rule.met(light, 0.2); ++light.held) {
        CHECK(rule.wants_error(light) == (light.held == 4 || light.held == 8));
        CHECK(rule.next(light, 0, {1, 0.1}) == 1);
    }
    // 32 would be over the most.
    CHECK(light.held == 16);
    light.held = 8;
    CHECK(rule.met(light, 0.1));
}
