// SPDX-License-Identifier: Apache-2.0
// Sessions of the C interface: the bits of the program's frames, whatever moved in between.
// in: small scenes -> out: checks.
// docs/embedding.md
#include <thread>

#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

constexpr double kPosition[3] = {16, -4000, 256}, kTarget[3] = {0, 0, 1024};

Overrides with(const std::string& method, const Overrides& more = {}) {
    Overrides all{"method.name=\"" + method + "\"", "path.samples_per_pixel=3",
                  "collectors.generations=6", "raymarch.steps=40",
                  "output.layers=[\"radiance\",\"alpha\"]"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

/// The small cumulus, or for method particles what it shows.
std::string scene_for(const std::string& method) {
    const std::string text = kSmallCumulus;
    if (method != "particles") return text;
    const std::size_t from = text.find("[[medium]]"), to = text.find("[photon_grid]");
    return text.substr(0, from) +
           "[[medium]]\ndensity = \"assets/scenes/golden/data/puff.csv\"\n"
           "phase = { type = \"isotropic\" }\n" +
           text.substr(to);
}

/// Frame f of an animation of `frames`, which orbits by 60 degrees while the sun rises from -10
/// to 40.
void move(Hosted& host, int frame, int frames) {
    const double share = double(frame) / (frames - 1);
    double position[3];
    pileus_orbit(kPosition, kTarget, 60 * share, position);
    host.aim(position, kTarget, 40, 24, 14);
    host.sun(120, 10 + 30 * share);
    host.check(pileus_session_set_frame(host.session.get(), frame, &host.out.error));
}

}  // namespace

TEST_CASE("sessions: a still picture is the program's, in every method") {
    for (const char* method :
         {"collectors", "photon-grid", "raymarch", "path", "optical-depth", "particles"}) {
        CAPTURE(method);
        Hosted host(scene_for(method), with(method));
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        host.step(host.whole());
        CHECK(host.hash() == program_hashes(scene_for(method), with(method))[0]);
    }
}

TEST_CASE("sessions: frames of a moving camera and sun are those of the program's animation") {
    constexpr int kFrames = 9;
    const Overrides moves = {"animation.frames=9", "animation.camera_orbit_deg=[0,60]",
                             "animation.sun_elevation_deg=[10,40]", "raymarch.temporal=2"};
    for (const char* method :
         {"collectors", "photon-grid", "raymarch", "path", "optical-depth", "particles"}) {
        CAPTURE(method);
        const auto expected = program_hashes(scene_for(method), with(method, moves), kFrames);
        Hosted host(scene_for(method), with(method, {"raymarch.temporal=2"}));
        const bool stays = std::string(method) == "collectors";
        const std::uint32_t whole = host.whole();
        for (int frame = 0; frame < kFrames; ++frame) {
            CAPTURE(frame);
            move(host, frame, kFrames);
            host.step(frame == 0 || !stays ? whole : 1);
            CHECK(host.hash() == expected[std::size_t(frame)]);
        }
        // The second picture and all others made nothing again.
        CHECK(host.stats().prepared == 1);
        CHECK(host.stats().pictures == kFrames);
    }
}

TEST_CASE("sessions: a camera, sun and ground set to what they are keep the samples") {
    Hosted host(kSmallCumulus, with("path"));
    double position[3];
    pileus_orbit(kPosition, kTarget, 0, position);
    const auto set = [&] {
        host.aim(position, kTarget, 40, 24, 14);
        host.sun(120, 35);
    };
    set();
    host.step(1);
    const std::string first = host.hash();
    set();
    host.step(2);
    const std::string third = host.hash();
    CHECK(third != first);
    host.sun(120, 36);
    set();
    host.step(3);
    CHECK(host.hash() == third);
}

TEST_CASE("sessions: what was set and set back leaves no trace") {
    for (const char* method : {"collectors", "photon-grid", "raymarch", "path", "optical-depth"}) {
        CAPTURE(method);
        Hosted host(kSmallCumulus, with(method));
        const std::uint32_t whole = host.whole();
        host.step(whole);
        const std::string first = host.hash();
        CHECK(host.hash() == first);  // drawing changes nothing

        const double aside[3] = {3000, 0, 100};
        host.aim(aside, kTarget, 30, 31, 7);
        auto placement = cleared<pileus_placement>();
        placement.offset_m[0] = 500;
        placement.yaw_deg = 33;
        host.check(pileus_session_set_placement(host.session.get(), &placement, &host.out.error));
        auto sky = cleared<pileus_environment>();
        sky.present = 1;
        sky.radiance[1] = 2;
        host.check(pileus_session_set_environment(host.session.get(), &sky, &host.out.error));
        std::vector<float> depth(31 * 7, 100.0f);
        auto image = cleared<pileus_depth_image>();
        image.values = depth.data();
        host.check(pileus_session_set_depth(host.session.get(), &image, &host.out.error));
        host.step(1);
        CHECK(host.hash() != first);

        image.values = nullptr;
        host.check(pileus_session_set_depth(host.session.get(), &image, &host.out.error));
        placement = cleared<pileus_placement>();
        host.check(pileus_session_set_placement(host.session.get(), &placement, &host.out.error));
        sky.radiance[0] = 0.0625f;
        sky.radiance[1] = 0.125f;
        sky.radiance[2] = 0.25f;
        host.check(pileus_session_set_environment(host.session.get(), &sky, &host.out.error));
        host.aim(kPosition, kTarget, 40, 24, 14);
        if (std::string(method) == "collectors") continue;  // its ring holds other generations now
        host.step(whole);
        CHECK(host.hash() == first);
    }
}

TEST_CASE("sessions: a placement is the scene moved the other way") {
    for (const char* method : {"raymarch", "path"}) {
        CAPTURE(method);
        Hosted host(kSmallCumulus, with(method));
        auto placement = cleared<pileus_placement>();
        placement.offset_m[0] = 1024;
        placement.offset_m[2] = 256;
        host.check(pileus_session_set_placement(host.session.get(), &placement, &host.out.error));
        host.step(host.whole());
        const Overrides moved =
            with(method, {"camera.position_m=[-1008,-4000,0]", "camera.target_m=[-1024,0,768]",
                          "ground.altitude_m=-256"});
        CHECK(host.hash() == program_hashes(kSmallCumulus, moved)[0]);
    }
    // A quarter turn: the camera goes round the other way, and so does the sun.
    Hosted host(kSmallCumulus, with("raymarch"));
    auto placement = cleared<pileus_placement>();
    placement.yaw_deg = 90;
    host.check(pileus_session_set_placement(host.session.get(), &placement, &host.out.error));
    const Overrides turned =
        with("raymarch", {"camera.position_m=[-4000,-16,256]", "sun.azimuth_deg=210"});
    CHECK(host.hash() == program_hashes(kSmallCumulus, turned)[0]);
}

TEST_CASE("sessions: lights that come and go") {
    Hosted host(kSmallCumulus, with("collectors", {"sun.elevation_deg=-20"}));
    const std::uint32_t whole = host.whole();
    host.step(whole);
    const std::string night = host.hash();
    CHECK(host.stats().prepared == 1);
    host.sun(120, 35);
    // The ring had no place for the sun: it begins anew.
    host.step(whole);
    const std::string day = host.hash();
    CHECK(day != night);
    CHECK(host.stats().prepared == 2);
    // Its light stays in the ring at dusk until all its generations have left.
    host.sun(120, -20);
    host.step(1);
    CHECK(host.stats().prepared == 2);
    host.step(whole);
    host.sun(120, 35);
    host.step(whole);
    CHECK(host.stats().prepared == 2);
    auto light = cleared<pileus_progress>();
    host.check(pileus_session_progress(host.session.get(), &light, &host.out.error));
    CHECK(light.units == whole);
    CHECK(std::string(light.unit) == "generation");
}

TEST_CASE("sessions: several of one world share its memory, in four threads") {
    Hosted first(kSmallCumulus, with("raymarch"));
    const std::string expected = first.hash();
    std::vector<std::string> hashes(4);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < hashes.size(); ++i)
        threads.emplace_back([&, i] {
            auto host = cleared<pileus_host>();
            host.threads = 1;
            pileus_session* session = nullptr;
            auto error = cleared<pileus_error>();
            if (pileus_session_create(first.world.get(), first.scene.get(), &host, &session,
                                      &error) != PILEUS_OK)
                return;
            auto frame = cleared<pileus_frame>();
            std::uint64_t hash = 0;
            frame.hash = &hash;
            for (int turn = 0; turn < 3; ++turn)
                (void)pileus_session_render(session, &frame, &error);
            char text[17];
            std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
            hashes[i] = text;
            pileus_session_free(session);
        });
    for (std::thread& t : threads) t.join();
    for (const std::string& hash : hashes) CHECK(hash == expected);
    CHECK(first.stats().shared_bytes >= 24 * 24 * 16 * sizeof(float));

    // Other methods over the same world, which outlives its handle.
    for (const char* method : {"collectors", "path"}) {
        const SceneHandle scene = scene_of(kSmallCumulus, with(method));
        pileus_session* session = nullptr;
        Outcome out;
        REQUIRE(pileus_session_create(first.world.get(), scene.get(), nullptr, &session,
                                      &out.error) == PILEUS_OK);
        first.session.reset(session);
        first.step(first.whole());
        CHECK(first.hash() == program_hashes(kSmallCumulus, with(method))[0]);
    }
    first.world.reset();
    first.scene.reset();
    CHECK(first.hash().size() == 16);
}

TEST_CASE("sessions: densities of the host's own memory") {
    const std::string text = R"(
[camera]
position_m = [0, -300, 0]
target_m = [0, 0, 0]
resolution = [9, 7]
[sun]
[[medium]]
density = "uniform:box"
bounds_m = [[-50, -50, -50], [50, 50, 50]]
extinction_per_m = 0.02
albedo = 0.9
[method]
name = "raymarch"
)";
    const SceneHandle scene = scene_of(text, {});
    std::vector<float> ones(4 * 3 * 2, 1.0f);
    auto density = cleared<pileus_density>();
    density.size[0] = 4;
    density.size[1] = 3;
    density.size[2] = 2;
    density.values = ones.data();
    const auto hash_of = [&] {
        pileus_world* world = nullptr;
        Outcome out;
        REQUIRE_MESSAGE(
            pileus_world_create(scene.get(), nullptr, &density, 1, &world, &out.error) == PILEUS_OK,
            out.line());
        const WorldHandle kept(world);
        pileus_session* session = nullptr;
        REQUIRE(pileus_session_create(world, scene.get(), nullptr, &session, &out.error) ==
                PILEUS_OK);
        const SessionHandle freed(session);
        auto frame = cleared<pileus_frame>();
        std::uint64_t hash = 0;
        frame.hash = &hash;
        REQUIRE(pileus_session_render(session, &frame, &out.error) == PILEUS_OK);
        return hash;
    };
    const std::uint64_t full = hash_of();
    ones[5] = 0;
    CHECK(hash_of() != full);
    ones[5] = -1;
    pileus_world* world = nullptr;
    Outcome out;
    CHECK(pileus_world_create(scene.get(), nullptr, &density, 1, &world, &out.error) ==
          PILEUS_ERROR_INPUT);
    CHECK(out.line() == "densities[0]: cell 5: -1.000000, allowed: finite and not negative");
    CHECK(world == nullptr);
}

TEST_CASE("sessions: the cloud's shadow on the ground, whatever size the last picture had") {
    for (const char* method : {"raymarch", "collectors"}) {
        CAPTURE(method);
        const double above[3] = {16, -3000, 4000}, ground[3] = {-600, 300, 0};
        std::string hashes[2];
        for (const bool twice : {false, true}) {
            Hosted host(kSmallCumulus, with(method));
            host.step(host.whole());
            // Nodes of the shadow are as many as these pixels allow; they lie where they lay.
            for (const std::uint32_t width : {twice ? 120u : 96u, 96u}) {
                host.aim(above, ground, 50, width, 64);
                hashes[twice] = host.hash();
            }
        }
        CHECK(hashes[0] == hashes[1]);
    }
}
