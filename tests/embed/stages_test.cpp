// SPDX-License-Identifier: Apache-2.0
// A frame's time belongs to named stages: what is in none cannot be found and grows unseen.
// in: frames of sessions and of animations -> out: checks.
// docs/realtime.md
#include <algorithm>

#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

constexpr int kFrames = 8, kWidth = 640, kHeight = 360;
/// What a frame does once, such as checking a camera, took 0.2 ms at most where these frames take
/// 10 and more. A processor that turns to another program between two stages adds to one frame,
/// hence the best of several; what is missing in the best one is missing in all. Where more
/// programs than processors run all the while, further rounds are given.
constexpr double kLeast = 0.97;
constexpr int kRounds = 6;

const Overrides kMethods[] = {
    {"method.name=\"collectors\""},
    {"method.name=\"collectors\"", "collectors.display=\"billboards\""},
    {"method.name=\"photon-grid\""},
    {"method.name=\"raymarch\"", "raymarch.scattering=\"octaves\""},
    {"method.name=\"raymarch\"", "raymarch.scattering=\"octaves\"", "raymarch.temporal=4"},
};

Overrides with(const Overrides& method, const Overrides& more) {
    Overrides all = method;
    for (const char* o :
         {"output.layers=[\"radiance\",\"alpha\"]", "medium.0.resolution=[64,64,48]",
          "collectors.samples=10000", "camera.resolution=[640,360]"})
        all.push_back(o);
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace

TEST_CASE("stages: a session's frame is in named stages, camera and sun moving") {
    for (const Overrides& method : kMethods) {
        CAPTURE(method[0]);
        CAPTURE(method.back());
        Hosted host(kSmallCumulus, with(method, {}));
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        std::vector<unsigned char> pixels(std::size_t(4) * kWidth * kHeight);
        auto frame = cleared<pileus_frame>();
        frame.colour = pixels.data();
        double best = 0;
        for (int f = 0; f < kRounds * kFrames && (f < kFrames || best < kLeast); ++f) {
            const double from[3] = {16.0 + 40 * f, -4000, 256}, to[3] = {0, 0, 1024};
            host.aim(from, to, 30, kWidth, kHeight);
            host.sun(120, 30 + f);
            host.step(f == 0 ? host.whole() : 1);
            host.check(pileus_session_render(host.session.get(), &frame, &host.out.error));
            const pileus_stats stats = host.stats();
            // Stages within one another would count twice.
            CHECK(stats.stages_s <= 1.0001 * stats.render_s);
            best = std::max(best, stats.stages_s / stats.render_s);
        }
        CHECK(best >= kLeast);
    }
}

TEST_CASE("stages: a frame of an animation is in named stages") {
    for (const Overrides& method : kMethods) {
        CAPTURE(method[0]);
        CAPTURE(method.back());
        pileus::Scene scene;
        REQUIRE(pileus::read_scene_text(
            kSmallCumulus, "scene", "",
            with(method, {"animation.frames=8", "animation.camera_orbit_deg=[0,20]",
                          "animation.sun_elevation_deg=[30,40]"}),
            scene));
        pileus::RenderOptions options;
        options.last_frame = kFrames - 1;
        options.digests = false;
        double best = 0;
        for (int round = 0; round < kRounds && best < kLeast; ++round) {
            double before = 0;
            const pileus::Status status =
                pileus::render(scene, options, [&](int f, pileus::Image&, pileus::Report& report) {
                    double staged = 0;
                    for (const pileus::StageTime& stage : report.clocks.stages)
                        staged += stage.wall_s;
                    if (f > 0)
                        best = std::max(best, (staged - before) / report.clocks.frame_wall_s);
                    before = staged;
                    return pileus::Status::ok();
                });
            REQUIRE_MESSAGE(bool(status), status.message);
        }
        CHECK(best >= kLeast);
    }
}
