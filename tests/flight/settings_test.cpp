// SPDX-License-Identifier: Apache-2.0
// Flights through every work and every kind of picture, whatever they were opened for.
// in: packed scenes of every method -> out: the pictures of ordinary sessions, nothing kept.
// docs/flight.md, "What may change"
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "include/pileus/pileus.h"
#include "tests/flight/flight_scene.h"
#include "tests/flight/program/fly_settings.h"
#include "tests/support/long_tests.h"

namespace {

using pileus::FlightNeed;

constexpr std::size_t kFlownPixels = 24 * 16;

struct FlownMemory {
    std::vector<unsigned char> pixels[2];
    std::vector<float> depths[2], solid = std::vector<float>(kFlownPixels, 1e30f);
    flown_memory view{};

    FlownMemory() {
        for (int i = 0; i < 2; ++i) {
            pixels[i].resize(16 * kFlownPixels);
            depths[i].resize(kFlownPixels);
            view.pixels[i] = pixels[i].data();
            view.depths[i] = depths[i].data();
        }
        for (std::size_t i = 0; i < kFlownPixels; i += 3) solid[i] = 3500;
        view.solid = solid.data();
    }
};

/// An ordinary session that has drawn what a flight has when it is open.
struct Ordinary {
    pileus_scene* scene = nullptr;
    pileus_world* world = nullptr;
    pileus_session* session = nullptr;

    Ordinary(const std::string& text, const std::vector<std::string>& overrides,
             const pileus_frame& frame, bool solid) {
        pileus_error error;
        PILEUS_INIT(error);
        const auto ok = [&](pileus_code code) {
            REQUIRE_MESSAGE(code == PILEUS_OK, std::string(error.message));
        };
        std::vector<const char*> texts;
        for (const std::string& o : overrides) texts.push_back(o.c_str());
        ok(pileus_scene_parse(text.c_str(), nullptr, texts.data(), std::uint32_t(texts.size()),
                              &scene, &error));
        pileus_host alone;
        PILEUS_INIT(alone);
        alone.threads = 1;
        ok(pileus_world_create(scene, &alone, nullptr, 0, &world, &error));
        ok(pileus_session_create(world, scene, &alone, &session, &error));
        if (solid) {
            const std::vector<float> nothing(kFlownPixels, __builtin_inff());
            pileus_depth_image depth;
            PILEUS_INIT(depth);
            depth.values = nothing.data();
            ok(pileus_session_set_depth(session, &depth, &error));
        }
        pileus_progress light;
        PILEUS_INIT(light);
        ok(pileus_session_progress(session, &light, &error));
        if (light.whole > 0) ok(pileus_session_step(session, light.whole, nullptr, &error));
        for (int i = 0; i < 2; ++i) ok(pileus_session_render(session, &frame, &error));
    }
    ~Ordinary() {
        pileus_session_free(session);
        pileus_world_free(world);
        pileus_scene_free(scene);
    }
    Ordinary(const Ordinary&) = delete;
};

struct SettingsRow {
    std::vector<std::string> overrides;
    unsigned lamps = 0;
    bool ground = true;
};

const SettingsRow kSettingsRows[] = {
    {{"method.name=collectors"}},
    {{"method.name=collectors", "collectors.temporal=4", "collectors.light_refresh=8"}},
    {{"method.name=collectors", "collectors.display=billboards"}},
    {{"method.name=raymarch"}},
    {{"method.name=raymarch"}, 2},
    {{"method.name=raymarch", "raymarch.temporal=2", "raymarch.jitter=blue-noise"}, 0, false},
    {{"method.name=optical-depth"}},
    {{"method.name=photon-grid"}, 2},
    {{"method.name=photon-grid", "photon_grid.ring=true"}, 0, false},
    {{"method.name=path"}},
    {{"method.name=particles", "medium.0.density=procedural:particle-cumulus",
      "medium.0.particle_cumulus.particles=200", "medium.0.extinction_per_m=0.02"},
     2},
    {{"method.name=particles", "medium.0.density=procedural:particle-cumulus",
      "medium.0.particle_cumulus.particles=200", "particles.display=billboards"}},
    {{"method.name=raymarch", "medium.0.density=procedural:sky", "raymarch.scale=4",
      "medium.0.sky={type=\"cumulus\",size=16,evaluate=\"direct\"}",
      "medium.0.resolution=[4,4,4]"}},
};

constexpr const char* kTwoLamps = R"(
[[light]]
type = "point"
position_m = [100, -900, 900]
intensity = 1000000
[[light]]
type = "point"
position_m = [-100, -900, 900]
intensity = 1000000
)";

}  // namespace

TEST_CASE("a flight goes through all works and kinds of pictures, as an ordinary session does") {
    // Works, formats, blends, hash, depths out and depth images in: each session a share of all.
    const unsigned stride = pileus::long_tests() ? 8 : 131;
    for (const SettingsRow& row : kSettingsRows) {
        std::string text = kFlightScene;
        if (!row.ground) text.erase(text.find("[ground]"), 9);
        if (row.lamps > 0) text += kTwoLamps;
        pileus::Scene scene;
        REQUIRE(pileus::read_scene_text(text.c_str(), "scene", "", row.overrides, scene));
        std::shared_ptr<const pileus::World> world;
        std::string bytes;
        REQUIRE(pileus::make_world(scene, {}, world));
        REQUIRE(pileus::pack_scene(scene, *world, bytes));
        FlightNeed need;
        REQUIRE(pileus::measure_flight(bytes, {}, need));
        // Four ways to open it, with depth images or without.
        for (int kind = 0; kind < 8; ++kind) {
            if (!pileus::long_tests() && kind % 4 != 0 && kind % 4 != 3) continue;
            CAPTURE(row.overrides.front() + " " + row.overrides.back());
            CAPTURE(kind);
            const bool solid = kind % 2 == 1;
            FlownMemory memory;
            std::uint64_t hash = 0;
            pileus_error error;
            pileus_frame frame;
            pileus_flight_use use;
            PILEUS_INIT(error);
            PILEUS_INIT(use);
            flown_opening(kind / 2, &memory.view, &hash, &frame);
            const Ordinary other(text, row.overrides, frame, solid);
            std::fill(memory.pixels[0].begin(), memory.pixels[0].end(), 0);
            std::fill(memory.depths[0].begin(), memory.depths[0].end(), 0.0f);
            std::vector<unsigned char> block(
                std::size_t(need.block + (solid ? 16 * kFlownPixels + 1024 : 0)));
            pileus_flight flight = flight_in(bytes, block, frame);
            flight.depth = solid ? 1 : 0;
            pileus_session* session = nullptr;
            const pileus_code opened = pileus_flight_open(&flight, &session, &error);
            REQUIRE_MESSAGE(opened == PILEUS_OK, std::string(error.message));
            memory.pixels[1] = memory.pixels[0];
            memory.depths[1] = memory.depths[0];
            memory.view.pixels[1] = memory.pixels[1].data();
            memory.view.depths[1] = memory.depths[1].data();
            const char* const wrong =
                fly_settings(session, other.session, &memory.view, kFlownPixels, solid ? 1 : 0,
                             row.lamps, unsigned(kind), stride);
            CHECK_MESSAGE(wrong == nullptr, std::string(wrong != nullptr ? wrong : ""));
            REQUIRE(pileus_flight_usage(session, &use, &error) == PILEUS_OK);
            CHECK(use.refused == 0);
            CHECK(use.kept == 0);
            CHECK(use.lost == 0);
            pileus_flight_close(session);
        }
    }
}
