// SPDX-License-Identifier: Apache-2.0
// Sunlight in slices: what a frame has depends on the last suns alone, and a sun that stands is
// everywhere. in: suns frame by frame, sessions, animations -> out: slices made, equal pictures.
// docs/realtime.md, "A sun that moves"
#include "src/picture/nodes/sun_slices.h"

#include <algorithm>

#include "src/base/angles.h"
#include "src/session/session.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

SunDirection sun_deg(double elevation_deg) {
    const SineCosine s = sincos_deg(elevation_deg);
    return {0, float(s.cosine), float(s.sine)};
}

std::vector<int> follow(int slices, std::int64_t turn, double elevation_deg, SunSlices& s) {
    return follow_sun({slices, turn, sun_deg(elevation_deg), nullptr}, s);
}

std::uint64_t hash_of(Session& session) {
    std::uint64_t hash = 0;
    FrameTarget target;
    target.hash = &hash;
    REQUIRE(session.render(target));
    return hash;
}

}  // namespace

TEST_CASE("sun slices: a sun that stands is made once, one that moves a slice a frame") {
    SunSlices s;
    CHECK(follow(4, 7, 30, s) == std::vector<int>{0, 1, 2, 3});
    CHECK(follow(4, 7, 30, s).empty());  // the same frame again
    CHECK(follow(4, 8, 30, s).empty());
    CHECK(follow(4, 9, 30.2, s) == std::vector<int>{1});
    CHECK(follow(4, 10, 30.4, s) == std::vector<int>{2});
    // It stops, and after as many frames as slices it is everywhere.
    CHECK(follow(4, 11, 30.4, s) == std::vector<int>{3});
    CHECK(follow(4, 12, 30.4, s) == std::vector<int>{0});
    CHECK(follow(4, 13, 30.4, s) == std::vector<int>{1});
    CHECK(follow(4, 14, 30.4, s).empty());
    for (const SunDirection& sun : s.held) CHECK(sun == sun_deg(30.4));
    CHECK(s.made == 9);
}

TEST_CASE("sun slices: one that leaps is everywhere at once, and one slice is every sun's") {
    SunSlices s;
    follow(4, 0, 30, s);
    CHECK(follow(4, 1, 32, s).size() == 4);
    CHECK(follow(4, 20, 32.1, s).size() == 4);  // nothing is known of the frames between
    SunSlices one;
    CHECK(follow(1, 0, 30, one) == std::vector<int>{0});
    CHECK(follow(1, 0, 30.01, one) == std::vector<int>{0});
    CHECK(follow(1, 5, 30.01, one).empty());
}

TEST_CASE("sun slices: an animation's frame is the same wherever the run begins") {
    using Settings = std::vector<std::string>;
    for (const Settings& own :
         {Settings{"method.name = \"collectors\"", "collectors.light_refresh = 3",
                   "collectors.first_order_split = true"},
          Settings{"method.name = \"raymarch\"", "raymarch.light_refresh = 3",
                   "raymarch.light = \"buffer-exact\""}}) {
        CAPTURE(own[0]);
        Settings settings{"animation.frames = 9", "animation.sun_elevation_deg = [30, 31]",
                          "output.layers = [\"radiance\", \"alpha\"]"};
        settings.insert(settings.end(), own.begin(), own.end());
        const Scene scene = scene_from(kSmallCumulus, settings);
        const auto hashes = [&](int first, int last) {
            std::vector<std::string> out;
            RenderOptions options;
            options.first_frame = first;
            options.last_frame = last;
            REQUIRE(render(scene, options, [&](int, Image&, Report& report) {
                out.push_back(report.hash);
                return Status::ok();
            }));
            return out;
        };
        const std::vector<std::string> all = hashes(0, 8), late = hashes(5, 8);
        REQUIRE(late.size() == 4);
        for (std::size_t i = 0; i < 4; ++i) CHECK(late[i] == all[5 + i]);
    }
}

TEST_CASE("sun slices: a host's sun that stops is the picture of a scene with it, to the bit") {
    for (const char* method : {"collectors", "photon-grid", "raymarch"}) {
        CAPTURE(method);
        std::string key = method;
        std::replace(key.begin(), key.end(), '-', '_');
        const auto scene_of = [&](const char* refresh) {
            return scene_from(
                kSmallCumulus,
                {"method.name = \"" + std::string(method) + "\"",
                 key + ".light_refresh = " + refresh, "raymarch.light = \"buffer-exact\"",
                 "camera.resolution = [120, 80]", "output.layers = [\"radiance\", \"alpha\"]"});
        };
        Session whole, sliced;
        for (Session* session : {&whole, &sliced}) {
            REQUIRE(session->open(scene_of(session == &whole ? "1" : "4"), {}, true, nullptr));
            std::uint64_t done = 0;
            REQUIRE(session->step(session->light().whole, done));
        }
        CHECK(hash_of(whole) == hash_of(sliced));
        Sun sun = scene_of("1").sun;
        sun.elevation_deg += 0.25;
        REQUIRE(whole.set_sun(sun));
        REQUIRE(sliced.set_sun(sun));
        const std::uint64_t wanted = hash_of(whole);
        CHECK(hash_of(sliced) != wanted);  // a quarter of the nodes has it
        for (int frame = 0; frame < 3; ++frame) hash_of(sliced);
        CHECK(hash_of(sliced) == wanted);
    }
}
