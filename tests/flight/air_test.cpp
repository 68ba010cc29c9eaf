// SPDX-License-Identifier: Apache-2.0
// Flights in clear air: packed as `pileus pack` does it, flown in the block that this tells.
// in: a small cloud in air, by every method -> out: hashes of ordinary sessions; counts of the
// block. docs/flight.md, "What may change"; docs/atmosphere.md
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "include/pileus/pileus.h"
#include "src/flight/flight.h"
#include "src/flight/pack.h"
#include "src/scene/read_scene.h"
#include "src/session/session.h"
#include "tests/flight/flight_scene.h"

namespace {

/// `dusk`: lit by the moon, with twilight left, airglow and stars.
pileus::Scene scene_in_air(const std::vector<std::string>& overrides, bool dusk = false) {
    std::string text = kFlightScene;
    const std::string sky = "[sky]\nradiance = [0.05, 0.07, 0.11]";
    const std::string sun = "[sun]\nazimuth_deg = 120\nelevation_deg = 35\n";
    text.replace(text.find(sky), sky.size(), "[atmosphere]\nturbidity = 4");
    if (dusk) {
        text.replace(text.find(sun), sun.size(), "");
        const std::string air = "[atmosphere]\n";
        text.replace(text.find(air), air.size(),
                     air +
                         "date = 2026-09-22\ntime = 19:40:00\nlatitude_deg = 28.3\n"
                         "longitude_deg = -16.6\nmoon = true\nstars = true\nairglow = true\n");
    }
    pileus::Scene scene;
    const pileus::Status read =
        pileus::read_scene_text(text.c_str(), "scene", "", overrides, scene);
    REQUIRE_MESSAGE(bool(read), read.message);
    return scene;
}

/// The bytes that a file of `pileus pack` holds.
std::string packed(const pileus::Scene& scene) {
    std::shared_ptr<const pileus::World> world;
    std::string bytes;
    REQUIRE(pileus::make_world(scene, {}, world));
    REQUIRE(pileus::pack_scene(scene, *world, bytes));
    pileus::FlightNeed need;
    const pileus::Status measured = pileus::measure_flight(bytes, {}, need);
    REQUIRE_MESSAGE(bool(measured), measured.message);
    pileus::tell_block(need.block, need.in_place, bytes);
    return bytes;
}

/// Where frame `number` is seen from, nearer each time, above and below the cloud's base.
pileus::Double3 place_of(int number) {
    return {16.0 + 50 * number, -4000.0 + 500 * number, number == 3 ? 900.0 : 256.0};
}

/// Hashes of an ordinary session's pictures from those places.
std::vector<std::uint64_t> ordinary(const pileus::Scene& scene, int frames) {
    pileus::Session session;
    std::uint64_t hash = 0, units = 0;
    std::vector<std::uint64_t> hashes;
    pileus::FrameTarget target;
    target.hash = &hash;
    REQUIRE(session.open(scene, {}, true, {}));
    REQUIRE(session.step(session.light().whole, units));
    REQUIRE(session.render(target));
    for (int number = 0; number < frames; ++number) {
        pileus::Camera camera = scene.camera;
        camera.position_m = place_of(number);
        REQUIRE(session.set_frame(number));
        REQUIRE(session.set_camera(camera));
        REQUIRE(session.step(1, units));
        REQUIRE(session.render(target));
        hashes.push_back(hash);
    }
    return hashes;
}

}  // namespace

TEST_CASE("in clear air every method flies in the block it is told, with the hashes of sessions") {
    constexpr int kFrames = 4;
    for (const char* method :
         {"collectors", "raymarch", "optical-depth", "photon-grid", "path", "dusk"}) {
        CAPTURE(std::string(method));
        const bool dusk = method == std::string("dusk");
        const pileus::Scene scene =
            scene_in_air({std::string("method.name=") + (dusk ? "raymarch" : method)}, dusk);
        const std::vector<std::uint64_t> expected = ordinary(scene, kFrames);
        const std::string bytes = packed(scene);
        pileus_error error;
        PILEUS_INIT(error);
        const auto ok = [&](pileus_code code) {
            REQUIRE_MESSAGE(code == PILEUS_OK, error.message);
        };
        pileus_packed head;
        PILEUS_INIT(head);
        ok(pileus_packed_read(bytes.data(), bytes.size(), &head, &error));
        std::vector<unsigned char> block(std::size_t(head.block_bytes)), pixels(24 * 16 * 4);
        std::uint64_t hash = 0;
        pileus_frame frame;
        PILEUS_INIT(frame);
        frame.colour = pixels.data();
        frame.hash = &hash;
        const pileus_flight flight = flight_in(bytes, block, frame);
        pileus_session* session = nullptr;
        ok(pileus_flight_open(&flight, &session, &error));
        for (int number = 0; number < kFrames; ++number) {
            const pileus::Double3 place = place_of(number);
            pileus_camera camera;
            PILEUS_INIT(camera);
            for (int a = 0; a < 3; ++a) camera.position_m[a] = place[a];
            camera.target_m[2] = 1024;
            camera.fov_deg = scene.camera.fov_deg;
            ok(pileus_session_set_frame(session, number, &error));
            ok(pileus_session_set_camera(session, &camera, &error));
            ok(pileus_session_step(session, 1, nullptr, &error));
            ok(pileus_session_render(session, &frame, &error));
            CHECK(hash == expected[std::size_t(number)]);
        }
        // The sky would have to be made anew, for which there is no memory.
        pileus_sun sun;
        PILEUS_INIT(sun);
        sun.present = 1;
        sun.azimuth_deg = 120;
        sun.elevation_deg = 20;
        CHECK(pileus_session_set_sun(session, &sun, &error) == PILEUS_ERROR_INPUT);
        CHECK(std::string(error.message) ==
              "sun: another than when the flight was opened, allowed: what it had");
        pileus_ground ground;
        PILEUS_INIT(ground);
        CHECK(pileus_session_set_ground(session, &ground, &error) == PILEUS_ERROR_INPUT);
        CHECK(std::string(error.message).find("ground: another than when") == 0);
        ok(pileus_session_render(session, &frame, &error));
        CHECK(hash == expected.back());
        pileus_flight_use use;
        PILEUS_INIT(use);
        ok(pileus_flight_usage(session, &use, &error));
        CHECK(use.refused + use.kept + use.lost == 0);
        CHECK(use.frame_bytes <= use.frame_room);
        pileus_flight_close(session);
    }
}

TEST_CASE("a quarter of the block that is told for clear air is refused") {
    const std::string bytes = packed(scene_in_air({"method.name=raymarch"}));
    pileus::PackedHead head;
    REQUIRE(pileus::read_packed_head(bytes.data(), bytes.size(), head));
    std::vector<unsigned char> block(std::size_t(head.block_bytes / 4)), pixels(24 * 16 * 4);
    pileus_error error;
    PILEUS_INIT(error);
    pileus_frame frame;
    PILEUS_INIT(frame);
    frame.colour = pixels.data();
    const pileus_flight flight = flight_in(bytes, block, frame);
    pileus_session* session = nullptr;
    CHECK(pileus_flight_open(&flight, &session, &error) == PILEUS_ERROR_LIMIT);
    CHECK(session == nullptr);
}
