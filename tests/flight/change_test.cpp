// SPDX-License-Identifier: Apache-2.0
// What may change while a flight is open does change the picture, and takes nothing from the block.
// in: flights of four methods with lights -> out: other pictures, counts of the block.
// docs/flight.md, "What may change"
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "include/pileus/pileus.h"
#include "src/flight/flight.h"
#include "src/flight/pack.h"
#include "src/scene/read_scene.h"
#include "src/session/session.h"
#include "tests/flight/flight_scene.h"

namespace {

constexpr const char* kLamps = R"(
[[light]]
type = "point"
position_m = [100, -900, 900]
intensity = 1000000
radius_m = 20
[[light]]
type = "spot"
position_m = [0, 0, 100]
target_m = [0, 0, 1024]
intensity = 1000000
)";

/// An open flight of 24 x 16 pixels.
struct Changing {
    std::string bytes;
    std::vector<unsigned char> block, pixels = std::vector<unsigned char>(24 * 16 * 4);
    std::uint64_t hash = 0;
    pileus_frame frame;
    pileus_session* session = nullptr;
    pileus_error error;

    explicit Changing(const std::vector<std::string>& overrides, const char* lamps = kLamps)
        : block(std::size_t{64} << 20) {
        PILEUS_INIT(error);
        PILEUS_INIT(frame);
        pileus::Scene scene;
        const std::string text = std::string(kFlightScene) + lamps;
        const pileus::Status read =
            pileus::read_scene_text(text.c_str(), "scene", "", overrides, scene);
        REQUIRE_MESSAGE(bool(read), read.message);
        std::shared_ptr<const pileus::World> world;
        REQUIRE(pileus::make_world(scene, {}, world));
        REQUIRE(pileus::pack_scene(scene, *world, bytes));
        frame.colour = pixels.data();
        frame.hash = &hash;
        const pileus_flight flight = flight_in(bytes, block, frame);
        ok(pileus_flight_open(&flight, &session, &error));
    }
    ~Changing() { pileus_flight_close(session); }
    Changing(const Changing&) = delete;

    void ok(pileus_code code) { REQUIRE_MESSAGE(code == PILEUS_OK, error.message); }
    std::uint64_t draw() {
        ok(pileus_session_step(session, 1, nullptr, &error));
        ok(pileus_session_render(session, &frame, &error));
        return hash;
    }
    void check_block() {
        pileus_flight_use use;
        PILEUS_INIT(use);
        ok(pileus_flight_usage(session, &use, &error));
        CHECK(use.refused + use.kept + use.lost == 0);
    }
};

const std::vector<std::string> kRows[] = {
    {"method.name=collectors"},
    {"method.name=raymarch"},
    {"method.name=photon-grid"},
    {"method.name=path"},
};

}  // namespace

TEST_CASE("lights, the sky, the ground and the place of the media change a flight's picture") {
    for (const std::vector<std::string>& row : kRows) {
        CAPTURE(row.front() + " " + row.back());
        Changing flight(row);
        std::uint64_t before = flight.draw();
        const auto differs = [&] {
            const std::uint64_t now = flight.draw();
            CHECK(now != before);
            before = now;
        };
        pileus_lamp lights[2];
        for (pileus_lamp& light : lights) {
            PILEUS_INIT(light);
            light.light[0] = light.light[1] = light.light[2] = 5e6f;
            light.position_m[1] = -700;
            light.position_m[2] = 900;
        }
        lights[1].type = PILEUS_LAMP_SPOT;
        lights[1].direction[1] = 1;
        lights[1].cone_deg = 60;
        flight.ok(pileus_session_set_lamps(flight.session, lights, 2, &flight.error));
        differs();
        pileus_environment sky;
        PILEUS_INIT(sky);
        sky.present = 1;
        for (float& c : sky.radiance) c = 0.3f;
        flight.ok(pileus_session_set_environment(flight.session, &sky, &flight.error));
        differs();
        pileus_ground ground;
        PILEUS_INIT(ground);
        ground.present = 1;
        ground.albedo = 0.7;
        flight.ok(pileus_session_set_ground(flight.session, &ground, &flight.error));
        differs();
        pileus_placement placement;
        PILEUS_INIT(placement);
        placement.offset_m[0] = 200;
        placement.yaw_deg = 30;
        flight.ok(pileus_session_set_placement(flight.session, &placement, &flight.error));
        differs();
        flight.check_block();
    }
}

TEST_CASE("matrices show what the camera shows that they stand for") {
    Changing flight({"method.name=raymarch"});
    pileus_camera camera;
    PILEUS_INIT(camera);
    camera.position_m[0] = 16, camera.position_m[1] = -4000, camera.position_m[2] = 1024;
    camera.target_m[0] = 16, camera.target_m[2] = 1024;
    camera.fov_deg = 40;
    flight.ok(pileus_session_set_camera(flight.session, &camera, &flight.error));
    const std::uint64_t from_camera = flight.draw();
    const std::vector<unsigned char> expected = flight.pixels;
    // Columns: to the right x, up z, the view along y; depths from 1 m to 10 km, -1 to 1.
    const double view[16] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, -16, -1024, -4000, 1};
    const double f = 1 / std::tan(20 * 3.14159265358979323846 / 180);
    double clip[16] = {f * 16 / 24,     0, 0, 0, 0, f, 0, 0, 0, 0, -10001.0 / 9999, -1, 0, 0,
                       -20000.0 / 9999, 0};
    const auto set = [&] {
        flight.ok(pileus_session_set_matrices(flight.session, view, clip, PILEUS_CLIP_MINUS_ONE, 0,
                                              0, &flight.error));
        return flight.draw();
    };
    set();
    for (std::size_t i = 0; i < expected.size(); ++i)
        CHECK(std::abs(int(flight.pixels[i]) - int(expected[i])) <= 1);
    // Off the middle, and parallel.
    clip[8] = 0.3;
    CHECK(set() != from_camera);
    const double parallel[16] = {1.0 / 1500, 0,           0, 0, 0, 1.0 / 1000,      0, 0, 0,
                                 0,          -2.0 / 9999, 0, 0, 0, -10001.0 / 9999, 1};
    std::copy(parallel, parallel + 16, clip);
    CHECK(set() != from_camera);
    // Refused, and the picture stays.
    const std::uint64_t before = flight.draw();
    CHECK(pileus_session_set_matrices(flight.session, view, clip, PILEUS_CLIP_MINUS_ONE, 48, 32,
                                      &flight.error) == PILEUS_ERROR_INPUT);
    clip[0] = 0;
    CHECK(pileus_session_set_matrices(flight.session, view, clip, PILEUS_CLIP_MINUS_ONE, 0, 0,
                                      &flight.error) == PILEUS_ERROR_INPUT);
    CHECK(flight.draw() == before);
    flight.check_block();
}

TEST_CASE("a flight's work can be set, within what its scene has") {
    for (const std::vector<std::string>& row : kRows) {
        CAPTURE(row.front() + " " + row.back());
        Changing flight(row);
        pileus_work work;
        PILEUS_INIT(work);
        flight.ok(pileus_session_work(flight.session, &work, &flight.error));
        flight.ok(pileus_session_set_work(flight.session, &work, &flight.error));
        work.scale = 3;
        CHECK(pileus_session_set_work(flight.session, &work, &flight.error) == PILEUS_ERROR_INPUT);
        flight.draw();
        pileus_stats stats;
        PILEUS_INIT(stats);
        flight.ok(pileus_session_stats(flight.session, &stats, &flight.error));
        CHECK(stats.pictures >= 1);
        CHECK(stats.prepared == 1);
        flight.check_block();
    }
}

TEST_CASE("a flat detector moves, and has no depths") {
    Changing flight({"method.name=path", "camera.projection=flux", "camera.height_m=600",
                     "medium.0.boundary=periodic"},
                    "");
    const std::uint64_t before = flight.draw();
    pileus_camera camera;
    PILEUS_INIT(camera);
    camera.position_m[2] = 1600;
    camera.up[1] = 1;
    camera.height_m = 600;
    flight.ok(pileus_session_set_camera(flight.session, &camera, &flight.error));
    CHECK(flight.draw() != before);
    flight.check_block();
    std::vector<float> depths(24 * 16);
    flight.frame.depth = depths.data();
    CHECK(pileus_session_render(flight.session, &flight.frame, &flight.error) ==
          PILEUS_ERROR_INPUT);
    CHECK(std::string(flight.error.message).find("frame.depth") != std::string::npos);
}
