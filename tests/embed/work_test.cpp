// SPDX-License-Identifier: Apache-2.0
// Work of frames: what a session was told to spend makes its pictures again, to the bit.
// in: small scenes, made-up times -> out: checks.
// docs/realtime.md, "Work and the governor"
#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

constexpr double kPosition[3] = {16, -4000, 256}, kTarget[3] = {0, 0, 1024};

Overrides with(const std::string& method, const Overrides& more = {}) {
    Overrides all{"method.name=\"" + method + "\"",
                  "path.samples_per_pixel=2",
                  "collectors.generations=6",
                  "photon_grid.generations=4",
                  "raymarch.steps=40",
                  "output.layers=[\"radiance\",\"alpha\"]"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

pileus_work work_of(Hosted& host) {
    auto work = cleared<pileus_work>();
    host.check(pileus_session_work(host.session.get(), &work, &host.out.error));
    return work;
}

pileus_code set(Hosted& host, const pileus_work& work) {
    return pileus_session_set_work(host.session.get(), &work, &host.out.error);
}

std::string report_of(Hosted& host) {
    std::vector<char> text(1u << 16);
    host.check(pileus_session_report(host.session.get(), text.data(), text.size(), nullptr,
                                     &host.out.error));
    return text.data();
}

/// Frame f: the camera orbits, the sun climbs, one generation is traced.
std::string frame_hash(Hosted& host, int frame) {
    double position[3];
    pileus_orbit(kPosition, kTarget, 3.0 * frame, position);
    host.aim(position, kTarget, 40, 24, 14);
    host.sun(120, 10 + 0.2 * frame);
    host.check(pileus_session_set_frame(host.session.get(), frame, &host.out.error));
    host.step(frame == 0 ? host.whole() : 1);
    return host.hash();
}

}  // namespace

TEST_CASE("work: a governed flight is made again from the work that was recorded") {
    for (const Overrides& way :
         {with("collectors"), with("collectors", {"collectors.temporal=2"}), with("raymarch"),
          with("raymarch", {"raymarch.temporal=2"}), with("photon-grid", {"photon_grid.ring=true"}),
          with("optical-depth", {"optical_depth.steps=40"})}) {
        CAPTURE(way[0]);
        Hosted host(kSmallCumulus, way);
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        auto governor = cleared<pileus_governor>();
        governor.target_s = 0.01;
        std::vector<pileus_work> chosen;
        std::vector<std::string> hashes;
        std::uint32_t deepest = 0;
        for (int frame = 0; frame < 60; ++frame) {
            auto work = cleared<pileus_work>();
            // Much too slow at first, then fast.
            const double seconds = frame == 0 ? 0 : frame < 20 ? 0.05 : 0.001;
            host.check(pileus_session_govern(host.session.get(), &governor, seconds, &work,
                                             &host.out.error));
            host.check(set(host, work));
            chosen.push_back(work);
            deepest = governor.level > deepest ? governor.level : deepest;
            hashes.push_back(frame_hash(host, frame));
        }
        CHECK(deepest >= 2);
        CHECK(governor.level < deepest);
        Hosted again(kSmallCumulus, way);
        for (int frame = 0; frame < 60; ++frame) {
            CAPTURE(frame);
            again.check(set(again, chosen[std::size_t(frame)]));
            CHECK(frame_hash(again, frame) == hashes[std::size_t(frame)]);
        }
    }
}

TEST_CASE("work: settings of a frame are those of a scene") {
    Hosted plain(kSmallCumulus, with("raymarch", {"raymarch.scale=4", "raymarch.steps=20"}));
    Hosted host(kSmallCumulus, with("raymarch"));
    const pileus_work whole = work_of(host);
    CHECK(whole.scale == 1);
    CHECK(whole.steps == 40);
    CHECK(whole.temporal == 0);
    CHECK(whole.photons == 0);
    const std::string first = frame_hash(host, 0);
    auto work = cleared<pileus_work>();
    work.scale = 4;
    work.steps = 20;
    host.check(set(host, work));
    CHECK(frame_hash(host, 0) == frame_hash(plain, 0));
    CHECK(report_of(host).find("\"scale\": 4") != std::string::npos);
    // Cleared: the scene's own again.
    host.check(set(host, cleared<pileus_work>()));
    CHECK(frame_hash(host, 0) == first);
}

TEST_CASE("work: a generation of fewer photons is no other's, and the ring's mean stays") {
    const Overrides way = with("collectors");
    Hosted host(kSmallCumulus, way);
    const pileus_work whole = work_of(host);
    REQUIRE(whole.photons > 16);
    auto work = cleared<pileus_work>();
    work.photons = whole.photons / 4;
    host.check(set(host, work));
    auto info = cleared<pileus_progress>();
    host.check(pileus_session_progress(host.session.get(), &info, &host.out.error));
    CHECK(info.unit_photons >= whole.photons / 4 - 2);
    CHECK(info.unit_photons <= whole.photons / 4 + 2);
    const std::string few = frame_hash(host, 0);
    Hosted other(kSmallCumulus, way);
    CHECK(frame_hash(other, 0) != few);
    // One photon a generation is a picture, too.
    work.photons = 1;
    host.check(set(host, work));
    frame_hash(host, 1);
}

TEST_CASE("work: what a method has not is one line") {
    const auto refused = [](Hosted& host, void (*change)(pileus_work&), const char* word) {
        auto work = cleared<pileus_work>();
        change(work);
        CHECK(set(host, work) == PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(host.out.line().find(word) != std::string::npos, host.out.line());
        CHECK(host.out.line().find('\n') == std::string::npos);
    };
    Hosted rays(kSmallCumulus, with("raymarch"));
    refused(
        rays, [](pileus_work& w) { w.photons = 1; }, "work.photons");
    refused(
        rays, [](pileus_work& w) { w.temporal = 2; }, "work.temporal");
    refused(
        rays, [](pileus_work& w) { w.scale = 3; }, "scale: 3");
    refused(
        rays, [](pileus_work& w) { w.light_refresh = 65; }, "light_refresh");
    refused(
        rays, [](pileus_work& w) { w.steps = 0xffffffffu; }, "work");
    Hosted boards(kSmallCumulus, with("collectors", {"collectors.display=\"billboards\""}));
    refused(
        boards, [](pileus_work& w) { w.scale = 2; }, "work.scale");
    refused(
        boards, [](pileus_work& w) { w.steps = 2; }, "work.steps");
    refused(
        boards, [](pileus_work& w) { w.photons = ~std::uint64_t{0}; }, "work.photons");
    Hosted sum(kSmallCumulus, with("photon-grid"));
    refused(
        sum, [](pileus_work& w) { w.photons = 10; }, "ring = true");
    Hosted path(kSmallCumulus, with("path"));
    refused(
        path, [](pileus_work& w) { w.light_refresh = 2; }, "work.light_refresh");
    const std::string before = frame_hash(rays, 0);
    Hosted fresh(kSmallCumulus, with("raymarch"));
    CHECK(frame_hash(fresh, 0) == before);
    auto governor = cleared<pileus_governor>();
    auto work = cleared<pileus_work>();
    CHECK(pileus_session_govern(rays.session.get(), &governor, 0, &work, &rays.out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK(rays.out.line().find("target_s") != std::string::npos);
    governor.target_s = 1;
    CHECK(pileus_session_govern(rays.session.get(), &governor, -1, &work, &rays.out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK(pileus_session_govern(rays.session.get(), nullptr, 1, &work, &rays.out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK(pileus_session_govern(rays.session.get(), &governor, 1, nullptr, &rays.out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK(pileus_session_set_work(nullptr, &work, &rays.out.error) == PILEUS_ERROR_INPUT);
}
