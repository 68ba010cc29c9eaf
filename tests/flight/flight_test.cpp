// SPDX-License-Identifier: Apache-2.0
// Flights by pileus.h: one block, nothing kept by frames, nothing asked of anyone.
// in: packed scenes of every method -> out: hashes as without a block; counts of the block.
// docs/flight.md
#include "src/flight/flight.h"

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

#include "include/pileus/pileus.h"
#include "tests/flight/flight_scene.h"

namespace {

using pileus::FlightNeed;

/// A flight over a packed scene, as a host flies it.
struct Flight {
    std::string scene;
    std::vector<unsigned char> block, pixels = std::vector<unsigned char>(24 * 16 * 4);
    std::uint64_t hash = 0;
    pileus_frame frame;
    pileus_flight setup;
    pileus_session* session = nullptr;
    pileus_error error;

    explicit Flight(const std::string& bytes) : scene(bytes) {
        PILEUS_INIT(frame);
        PILEUS_INIT(setup);
        PILEUS_INIT(error);
        pileus_packed head;
        PILEUS_INIT(head);
        REQUIRE(pileus_packed_read(scene.data(), scene.size(), &head, &error) == PILEUS_OK);
        CHECK(head.width == 24);
        block.resize(std::size_t(head.block_bytes));
        frame.colour = pixels.data();
        frame.hash = &hash;
        setup.scene = scene.data();
        setup.scene_bytes = scene.size();
        setup.block = block.data();
        setup.block_bytes = block.size();
        setup.frame = &frame;
    }
    ~Flight() { pileus_flight_close(session); }
    Flight(const Flight&) = delete;

    pileus_code open() { return pileus_flight_open(&setup, &session, &error); }

    pileus_code fly(int number) {
        pileus_camera camera;
        PILEUS_INIT(camera);
        camera.position_m[0] = 16 + 100 * number;
        camera.position_m[1] = -4000 + 300 * number;
        camera.position_m[2] = 256;
        camera.target_m[2] = 1024;
        camera.fov_deg = 40;
        pileus_sun sun;
        PILEUS_INIT(sun);
        sun.present = 1;
        sun.azimuth_deg = 120;
        sun.elevation_deg = 35 + 0.5 * number;
        for (float& c : sun.irradiance) c = 1;
        pileus_code code = pileus_session_set_frame(session, number, &error);
        if (code == PILEUS_OK) code = pileus_session_set_camera(session, &camera, &error);
        if (code == PILEUS_OK) code = pileus_session_set_sun(session, &sun, &error);
        if (code == PILEUS_OK) code = pileus_session_step(session, 1, nullptr, &error);
        if (code == PILEUS_OK) code = pileus_session_render(session, &frame, &error);
        return code;
    }

    pileus_flight_use use() {
        pileus_flight_use out;
        PILEUS_INIT(out);
        REQUIRE(pileus_flight_usage(session, &out, &error) == PILEUS_OK);
        return out;
    }
};

const std::vector<std::string> kRows[] = {
    {},
    {"collectors.display=billboards"},
    {"collectors.temporal=4"},
    {"collectors.scale=2"},
    {"collectors.node_filter=guided"},
    {"collectors.light_refresh=4"},
    // The camera in the medium when the flight is opened, and out of it afterwards.
    {"camera.position_m=[0,-100,1000]"},
    {"method.name=photon-grid", "camera.position_m=[0,-100,1000]"},
    {"sun.elevation_deg=90"},
    {"method.name=raymarch", "sun.elevation_deg=90"},
    {"method.name=photon-grid", "sun.elevation_deg=90"},
    {"camera.resolution=[24,16]", "medium.0.resolution=[1,16,16]", "medium.0.density=uniform:box"},
    {"method.name=raymarch"},
    {"method.name=raymarch", "raymarch.temporal=4", "raymarch.light_refresh=4"},
    {"method.name=raymarch", "raymarch.jitter=blue-noise"},
    {"method.name=optical-depth"},
    {"method.name=photon-grid"},
    {"method.name=photon-grid", "photon_grid.ring=true"},
    {"method.name=path"},
    {"method.name=particles", "medium.0.density=procedural:particle-cumulus",
     "medium.0.particle_cumulus.particles=400", "medium.0.extinction_per_m=0.02"},
    {"method.name=particles", "medium.0.density=procedural:particle-cumulus",
     "medium.0.particle_cumulus.particles=400", "particles.display=billboards"},
};

}  // namespace

TEST_CASE("every method flies in the block that its packed scene tells, and keeps nothing") {
    for (const std::vector<std::string>& row : kRows) {
        CAPTURE(row.empty() ? std::string("collectors") : row.front() + " " + row.back());
        FlightNeed need;
        Flight flight(packed_small(row, need));
        const pileus_code code = flight.open();
        REQUIRE_MESSAGE(code == PILEUS_OK, flight.error.message);
        for (int number = 0; number < 10; ++number) {
            const pileus_code flown = flight.fly(number);
            REQUIRE_MESSAGE(flown == PILEUS_OK, flight.error.message);
        }
        const pileus_flight_use use = flight.use();
        CHECK(use.refused == 0);
        CHECK(use.kept == 0);
        CHECK(use.lost == 0);
        CHECK(use.kept_bytes + use.frame_bytes <= use.block_bytes);
        CHECK(use.frame_bytes <= use.frame_room);
    }
}

TEST_CASE("a block that is too small is refused with a line, whatever its size") {
    FlightNeed need;
    const std::string bytes = packed_small({}, need);
    for (const double share : {0.0, 0.001, 0.1, 0.3, 0.6, 0.8}) {
        Flight flight(bytes);
        flight.setup.block_bytes = std::size_t(share * double(need.kept));
        CHECK(flight.open() == PILEUS_ERROR_LIMIT);
        CHECK(std::string(flight.error.message).find("flight.block: ") == 0);
        CHECK(flight.session == nullptr);
    }
}

TEST_CASE("a block at any address does") {
    FlightNeed need;
    const std::string bytes = packed_small({}, need);
    std::uint64_t hashes[3];
    for (std::size_t skipped = 0; skipped < 3; ++skipped) {
        Flight flight(bytes);
        flight.block.resize(flight.block.size() + 64);
        flight.setup.block = flight.block.data() + 7 * skipped;
        REQUIRE(flight.open() == PILEUS_OK);
        REQUIRE(flight.fly(3) == PILEUS_OK);
        hashes[skipped] = flight.hash;
    }
    CHECK(hashes[0] == hashes[1]);
    CHECK(hashes[0] == hashes[2]);
}

TEST_CASE("what would need memory of its own is refused once a flight is open, and does no harm") {
    FlightNeed need;
    Flight flight(packed_small({}, need));
    REQUIRE(flight.open() == PILEUS_OK);
    REQUIRE(flight.fly(1) == PILEUS_OK);
    const std::uint64_t before = flight.hash;
    pileus_camera camera;
    PILEUS_INIT(camera);
    camera.width = 48;
    camera.position_m[1] = -4000;
    camera.target_m[2] = 1024;
    camera.fov_deg = 40;
    CHECK(pileus_session_set_camera(flight.session, &camera, &flight.error) == PILEUS_ERROR_INPUT);
    CHECK(std::string(flight.error.message).find("camera.resolution: another than when") == 0);
    const float map[2 * 1 * 3] = {1, 1, 1, 1, 1, 1};
    pileus_environment sky;
    PILEUS_INIT(sky);
    sky.present = 1;
    sky.map_size[0] = 2;
    sky.map_size[1] = 1;
    sky.map = map;
    CHECK(pileus_session_set_environment(flight.session, &sky, &flight.error) ==
          PILEUS_ERROR_INPUT);
    std::vector<float> depth(24 * 16, 1000.0f);
    pileus_depth_image image;
    PILEUS_INIT(image);
    image.values = depth.data();
    CHECK(pileus_session_set_depth(flight.session, &image, &flight.error) == PILEUS_ERROR_INPUT);
    pileus_lamp light;
    PILEUS_INIT(light);
    CHECK(pileus_session_set_lamps(flight.session, &light, 1, &flight.error) != PILEUS_OK);
    REQUIRE(flight.fly(1) == PILEUS_OK);
    const pileus_flight_use use = flight.use();
    CHECK(use.kept + use.lost + use.refused == 0);
    // One generation more was shot, from another place of the ring.
    CHECK(flight.hash != 0);
    CHECK(before != 0);
}

TEST_CASE("a sun may go and come back; one that was not there, a sky or a ground is refused") {
    for (const char* method : {"collectors", "raymarch", "optical-depth", "photon-grid", "path"}) {
        CAPTURE(method);
        const std::string name = std::string("method.name=") + method;
        FlightNeed need;
        Flight flight(packed_small({name}, need));
        REQUIRE(flight.open() == PILEUS_OK);
        pileus_sun none;
        PILEUS_INIT(none);
        const auto draw = [&] {
            const pileus_code code = pileus_session_step(flight.session, 1, nullptr, &flight.error);
            return code != PILEUS_OK
                       ? code
                       : pileus_session_render(flight.session, &flight.frame, &flight.error);
        };
        for (int turn = 0; turn < 2; ++turn) {
            REQUIRE(flight.fly(turn) == PILEUS_OK);
            REQUIRE(pileus_session_set_sun(flight.session, &none, &flight.error) == PILEUS_OK);
            const pileus_code code = draw();
            REQUIRE_MESSAGE(code == PILEUS_OK, flight.error.message);
        }
        REQUIRE(flight.fly(3) == PILEUS_OK);
        pileus_ground ground;
        PILEUS_INIT(ground);
        REQUIRE(pileus_session_set_ground(flight.session, &ground, &flight.error) == PILEUS_OK);
        CHECK(draw() == PILEUS_ERROR_INPUT);
        ground.present = 1;
        ground.albedo = 0.2;
        REQUIRE(pileus_session_set_ground(flight.session, &ground, &flight.error) == PILEUS_OK);
        CHECK(draw() == PILEUS_OK);
        pileus_flight_use use = flight.use();
        CHECK(use.refused + use.kept + use.lost == 0);
        // At the horizon of a ground the sun does not shine.
        Flight dawn(packed_small({name, "sun.elevation_deg=0"}, need));
        REQUIRE(dawn.open() == PILEUS_OK);
        CHECK(dawn.fly(1) == PILEUS_ERROR_INPUT);
        use = dawn.use();
        CHECK(use.refused + use.kept + use.lost == 0);
    }
}

TEST_CASE("depth images come and go where a flight was opened for them") {
    FlightNeed need;
    Flight flight(packed_small({"method.name=raymarch"}, need));
    flight.setup.depth = 1;
    flight.block.resize(flight.block.size() + 65536);
    flight.setup.block = flight.block.data();
    flight.setup.block_bytes = flight.block.size();
    REQUIRE(flight.open() == PILEUS_OK);
    std::vector<float> depth(24 * 16, 1000.0f);
    pileus_depth_image image;
    PILEUS_INIT(image);
    std::uint64_t hashes[3];
    for (int i = 0; i < 3; ++i) {
        image.values = i == 1 ? depth.data() : nullptr;
        REQUIRE(pileus_session_set_depth(flight.session, &image, &flight.error) == PILEUS_OK);
        REQUIRE(flight.fly(2) == PILEUS_OK);
        hashes[i] = flight.hash;
    }
    CHECK(hashes[0] == hashes[2]);
    CHECK(hashes[0] != hashes[1]);
    const pileus_flight_use use = flight.use();
    CHECK(use.kept + use.lost + use.refused == 0);
}

TEST_CASE("wrong use of pileus.h has a line and a code") {
    FlightNeed need;
    Flight flight(packed_small({}, need));
    const auto refused = [&](const char* words) {
        CHECK(flight.open() == PILEUS_ERROR_INPUT);
        CHECK(std::string(flight.error.message).find(words) == 0);
    };
    std::uint32_t size = 0;
    const void* no_scene = nullptr;
    pileus_packed head;
    PILEUS_INIT(head);
    CHECK(pileus_packed_read(nullptr, 4096, &head, &flight.error) == PILEUS_ERROR_INPUT);
    CHECK(std::string(flight.error.message) == "scene: null, allowed: a packed scene");
    CHECK(pileus_flight_open(nullptr, &flight.session, &flight.error) == PILEUS_ERROR_INPUT);
    CHECK(pileus_flight_open(&flight.setup, nullptr, &flight.error) == PILEUS_ERROR_INPUT);
    flight.setup.block = nullptr;
    refused("flight.block: null");
    flight.setup.block = flight.block.data();
    flight.setup.frame = nullptr;
    refused("flight.frame: null");
    flight.setup.frame = &flight.frame;
    // A frame of no header at all; sizes that no memory has.
    std::swap(flight.frame.struct_size, size);
    refused("flight.frame: not initialised");
    std::swap(flight.frame.struct_size, size);
    std::swap(flight.setup.scene, no_scene);
    refused("flight.scene: null");
    std::swap(flight.setup.scene, no_scene);
    for (const std::size_t most : {SIZE_MAX, SIZE_MAX - 4096}) {
        const std::size_t block = flight.setup.block_bytes, scene = flight.setup.scene_bytes;
        flight.setup.block_bytes = most;
        refused("flight.block_bytes: beyond the end of memory");
        flight.setup.block_bytes = block;
        flight.setup.scene_bytes = most;
        refused("flight.scene_bytes: beyond the end of memory");
        flight.setup.scene_bytes = scene;
    }
    flight.setup.threads = 2000;
    refused("flight.threads: ");
    flight.setup.threads = 0;
    flight.setup.scene_bytes -= 1;
    refused("packed scene: ");
    flight.setup.scene_bytes += 1;
    flight.setup.isa = "none";
    refused("--isa: ");
    flight.setup.isa = nullptr;
    CHECK(pileus_flight_usage(nullptr, nullptr, &flight.error) == PILEUS_ERROR_INPUT);
    REQUIRE(flight.open() == PILEUS_OK);
}
