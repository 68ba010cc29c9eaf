// SPDX-License-Identifier: Apache-2.0
// A small cloud that every method shows, whose phase function is a table.
// in: overrides -> out: the text of a scene; that scene packed, and how it is opened.
#pragma once
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "include/pileus/pileus.h"
#include "src/flight/flight.h"
#include "src/scene/read_scene.h"

constexpr const char* kFlightScene = R"(
[camera]
position_m = [16, -4000, 256]
target_m = [0, 0, 1024]
resolution = [24, 16]
[sun]
azimuth_deg = 120
elevation_deg = 35
[sky]
radiance = [0.05, 0.07, 0.11]
[ground]
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-512, -512, 512], [512, 512, 1536]]
resolution = [16, 16, 16]
extinction_per_m = 0.02
phase = { type = "cloud", effective_radius_um = 10 }
[collectors]
photons = 2000
generations = 4
[photon_grid]
photons = 2000
generations = 4
[path]
samples_per_pixel = 1
)";

/// The scene with overrides, packed, as a session of it needs.
inline std::string packed_small(const std::vector<std::string>& overrides,
                                pileus::FlightNeed& need) {
    pileus::Scene scene;
    const pileus::Status read =
        pileus::read_scene_text(kFlightScene, "scene", "", overrides, scene);
    REQUIRE_MESSAGE(bool(read), read.message);
    std::shared_ptr<const pileus::World> world;
    std::string bytes;
    REQUIRE(pileus::make_world(scene, {}, world));
    REQUIRE(pileus::pack_scene(scene, *world, bytes));
    const pileus::Status measured = pileus::measure_flight(bytes, {}, need);
    REQUIRE_MESSAGE(bool(measured), measured.message);
    pileus::tell_block(need.block, need.in_place, bytes);
    return bytes;
}

/// How a packed scene is opened in a block. All must outlive the session.
inline pileus_flight flight_in(const std::string& bytes, std::vector<unsigned char>& block,
                               pileus_frame& frame) {
    pileus_flight flight;
    PILEUS_INIT(flight);
    flight.scene = bytes.data();
    flight.scene_bytes = bytes.size();
    flight.block = block.data();
    flight.block_bytes = block.size();
    flight.frame = &frame;
    return flight;
}
