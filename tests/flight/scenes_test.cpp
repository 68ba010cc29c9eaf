// SPDX-License-Identifier: Apache-2.0
// All that a packed scene may hold is flown: lights, air, sky maps, skies in place, every phase
// function. in: the scenes of assets/scenes/golden and identity, small -> out: hashes of ordinary
// sessions over the scenes themselves; nothing kept by a call. docs/flight.md, "Promises"
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "include/pileus/pileus.h"
#include "src/flight/flight.h"
#include "src/flight/pack.h"
#include "src/scene/read_scene.h"
#include "src/session/session.h"
#include "tests/flight/flight_scene.h"
#include "tests/support/long_tests.h"

namespace {

constexpr int kSide = 16;

std::vector<std::string> scenes_of(const char* folder) {
    std::vector<std::string> found;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string("assets/scenes/") + folder))
        if (entry.path().extension() == ".toml") found.push_back(entry.path().string());
    std::sort(found.begin(), found.end());
    return found;
}

/// The picture of an ordinary session that has drawn as often as a flight has when it is open.
std::uint64_t ordinary(const pileus::Scene& scene) {
    pileus::Session session;
    std::uint64_t hash = 0, units = 0;
    REQUIRE(session.open(scene, {}, true, {}));
    REQUIRE(session.step(session.light().whole, units));
    pileus::FrameTarget target;
    target.hash = &hash;
    for (int i = 0; i < 3; ++i) REQUIRE(session.render(target));
    return hash;
}

/// Opens the packed scene in a block and draws it, then frames from other places.
void fly(const pileus::Scene& scene, const std::string& bytes, std::vector<unsigned char>& block) {
    std::uint64_t hash = 0;
    const std::uint64_t expected = ordinary(scene);
    std::vector<unsigned char> pixels(4 * kSide * kSide);
    pileus_error error;
    PILEUS_INIT(error);
    pileus_frame frame;
    PILEUS_INIT(frame);
    frame.colour = pixels.data();
    frame.hash = &hash;
    const pileus_flight flight = flight_in(bytes, block, frame);
    pileus_session* session = nullptr;
    const auto ok = [&](pileus_code code) { REQUIRE_MESSAGE(code == PILEUS_OK, error.message); };
    ok(pileus_flight_open(&flight, &session, &error));
    ok(pileus_session_render(session, &frame, &error));
    CHECK(hash == expected);
    pileus_camera camera;
    PILEUS_INIT(camera);
    for (std::size_t a = 0; a < 3; ++a) {
        camera.position_m[a] = scene.camera.position_m[a];
        camera.target_m[a] = scene.camera.target_m[a];
    }
    if (scene.camera.orthographic)
        camera.height_m = scene.camera.height_m;
    else
        camera.fov_deg = scene.camera.fov_deg;
    for (int number = 1; number < 3; ++number) {
        camera.position_m[0] += 20;
        camera.position_m[2] += 10;
        ok(pileus_session_set_frame(session, number, &error));
        const pileus_code moved = pileus_session_set_camera(session, &camera, &error);
        // Light that was gathered towards one view is for that view alone.
        if (scene.collectors.closure.camera) {
            CHECK(moved == PILEUS_ERROR_INPUT);
            CHECK(std::string(error.message).find("closure \"camera\"") != std::string::npos);
            break;
        }
        ok(moved);
        ok(pileus_session_step(session, 1, nullptr, &error));
        ok(pileus_session_render(session, &frame, &error));
    }
    pileus_flight_use use;
    PILEUS_INIT(use);
    ok(pileus_flight_usage(session, &use, &error));
    CHECK(use.refused == 0);
    CHECK(use.kept == 0);
    CHECK(use.lost == 0);
    pileus_flight_close(session);
}

/// Flies a folder's scenes; what a flight does not have is left out of them, or is refused in a
/// line.
void fly_all(const char* folder, int least) {
    int flown = 0;
    // Lights of photons have sums of their own, of media that shine, too. One flight finds what
    // another has left there.
    std::vector<unsigned char> block(std::size_t{512} << 20);
    for (const std::string& file : scenes_of(folder)) {
        INFO(file);
        pileus::Scene scene;
        const std::string size = std::to_string(kSide);
        const pileus::Status read = pileus::read_scene_file(
            file,
            {"camera.resolution=[" + size + "," + size + "]", "collectors.photons=2000",
             "photon_grid.photons=2000", "path.samples_per_pixel=2"},
            scene);
        REQUIRE_MESSAGE(bool(read), read.message);
        // Skies of clouds are no sessions (docs/clouds.md).
        if (scene.clouds.present()) continue;
        scene.animation = {};
        std::shared_ptr<const pileus::World> world;
        std::string bytes;
        REQUIRE(pileus::make_world(scene, {}, world));
        const pileus::Status packed = pileus::pack_scene(scene, *world, bytes);
        if (!packed) {
            CHECK_MESSAGE(packed.message.find(", allowed: ") != std::string::npos, packed.message);
            CHECK((!scene.solids.empty() || scene.media.front().detail.present() ||
                   scene.path.importance == pileus::ImportanceUse::kOn));
            continue;
        }
        if (pileus::long_tests()) {
            pileus::FlightNeed need;
            REQUIRE(pileus::measure_flight(bytes, {}, need));
            block = std::vector<unsigned char>(std::size_t(need.block));
        }
        fly(scene, bytes, block);
        ++flown;
    }
    CHECK(flown >= least);
}

}  // namespace

TEST_CASE("golden scenes fly, with the hashes of ordinary sessions") { fly_all("golden", 30); }

TEST_CASE("identity scenes fly, with the hashes of ordinary sessions") { fly_all("identity", 25); }
