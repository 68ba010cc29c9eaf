// SPDX-License-Identifier: Apache-2.0
// Particles from a host's memory.
// in: a scene whose file of particles need not exist -> out: the bits of the program on that file.
// docs/embedding.md, "Worlds"; docs/particles.md
#include "include/pileus/pileus.hpp"
#include "tests/embed/host_harness.h"
#include "tests/io/temp_folder.h"

using namespace host_test;

namespace {

/// As a simulation keeps them: other numbers between.
struct Puff {
    float position[3], speed[3], radius, density, colour[3], glow[3];
    std::uint64_t id;
};

/// Numbers that text and floats hold alike.
std::vector<Puff> puffs(std::size_t count) {
    std::vector<Puff> made(count);
    std::uint32_t state = 7;
    const auto draw = [&](float steps) {
        state = state * 1664525u + 1013904223u;
        return float(int(float(state >> 8) / 0x1p24f * steps * 4)) / 4;
    };
    for (std::size_t i = 0; i < count; ++i)
        made[i] = {{draw(80) - 40, draw(80) - 40, 10 + draw(80)},
                   {draw(8), 2, -draw(8)},
                   4 + draw(9),
                   draw(8) / 64,
                   {draw(4) / 4, 0.5f, 1},
                   {1, draw(8), 0.25f},
                   3 * i};
    return made;
}

std::string table_of(const std::vector<Puff>& puffs) {
    std::string text =
        "x,y,z,vx,vy,vz,radius,density,id,red,green,blue,emission_red,emission_green,emission_"
        "blue\n";
    for (const Puff& p : puffs) {
        char row[400];
        std::snprintf(
            row, sizeof row,
            "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%llu,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n",
            double(p.position[0]), double(p.position[1]), double(p.position[2]), double(p.speed[0]),
            double(p.speed[1]), double(p.speed[2]), double(p.radius), double(p.density),
            static_cast<unsigned long long>(p.id), double(p.colour[0]), double(p.colour[1]),
            double(p.colour[2]), double(p.glow[0]), double(p.glow[1]), double(p.glow[2]));
        text += row;
    }
    return text;
}

std::string scene_text(const std::string& file, const std::string& more) {
    return "[camera]\nposition_m = [0, -300, 50]\ntarget_m = [0, 0, 50]\nresolution = [16, 12]\n"
           "[sun]\nelevation_deg = 30\nazimuth_deg = 100\n[ground]\naltitude_m = -5\n"
           "[[medium]]\ndensity = { file = \"" +
           file + "\"" + more +
           " }\nemission = 0.25\nphase = { type = \"henyey-greenstein\", g = 0.5 }\n"
           "[raymarch]\nsteps = 20\n[output]\nlayers = [\"radiance\", \"alpha\"]\n";
}

pileus_particles particles_of(const std::vector<Puff>& puffs) {
    auto given = cleared<pileus_particles>();
    given.count = puffs.size();
    given.position = puffs[0].position;
    given.radius = &puffs[0].radius;
    given.density = &puffs[0].density;
    given.id = &puffs[0].id;
    given.position_stride = given.radius_stride = given.density_stride = given.id_stride =
        given.velocity_stride = sizeof(Puff);
    given.velocity = puffs[0].speed;
    given.colour = puffs[0].colour;
    given.emission = puffs[0].glow;
    given.colour_stride = given.emission_stride = sizeof(Puff);
    return given;
}

pileus_code world_of(const SceneHandle& scene, const pileus_particles& particles, Outcome& out,
                     WorldHandle& world, std::uint32_t medium = 0) {
    auto density = cleared<pileus_density>();
    density.medium = medium;
    density.particles = &particles;
    pileus_world* made = nullptr;
    const pileus_code code =
        pileus_world_create(scene.get(), nullptr, &density, 1, &made, &out.error);
    world.reset(made);
    return code;
}

std::string hash_by(const SceneHandle& scene, const WorldHandle& world) {
    pileus_session* session = nullptr;
    Outcome out;
    REQUIRE_MESSAGE(
        pileus_session_create(world.get(), scene.get(), nullptr, &session, &out.error) == PILEUS_OK,
        out.line());
    const SessionHandle kept(session);
    auto frame = cleared<pileus_frame>();
    std::uint64_t hash = 0;
    frame.hash = &hash;
    REQUIRE(pileus_session_render(session, &frame, &out.error) == PILEUS_OK);
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

}  // namespace

TEST_CASE("particles of a host: the bits of the same particles in a file") {
    const std::vector<Puff> made = puffs(60);
    const pileus::test::TempFolder folder;
    folder.put("p.csv", table_of(made));
    for (const char* method : {"particles", "raymarch"})
        for (const char* more : {"", ", share = 0.5", ", holds = \"cross-section\", unit_m = 2"}) {
            CAPTURE(method);
            CAPTURE(more);
            const Overrides overrides = {"method.name=\"" + std::string(method) + "\""};
            const SceneHandle scene = scene_of(scene_text("none.csv", more), overrides);
            Outcome out;
            WorldHandle world;
            REQUIRE_MESSAGE(world_of(scene, particles_of(made), out, world) == PILEUS_OK,
                            out.line());
            CHECK(hash_by(scene, world) ==
                  program_hashes(scene_text(folder.path("p.csv"), more), overrides)[0]);
        }
}

TEST_CASE("particles of a host: a world of them is for the methods that it was made for") {
    const std::vector<Puff> made = puffs(20);
    const SceneHandle shown = scene_of(scene_text("none.ply", ""), {"method.name=\"particles\""});
    const SceneHandle marched = scene_of(scene_text("none.ply", ""), {"method.name=\"raymarch\""});
    for (const bool turned : {false, true}) {
        Outcome out;
        WorldHandle world;
        REQUIRE(world_of(turned ? marched : shown, particles_of(made), out, world) == PILEUS_OK);
        pileus_session* session = nullptr;
        CHECK(pileus_session_create(world.get(), (turned ? shown : marched).get(), nullptr,
                                    &session, &out.error) == PILEUS_ERROR_INPUT);
        CHECK(session == nullptr);
        CHECK(out.line().find("a world made for it") != std::string::npos);
    }
}

TEST_CASE("particles of a host: none, one, and what is wrong says so") {
    const SceneHandle scene = scene_of(scene_text("none.ply", ""), {"method.name=\"particles\""});
    std::vector<Puff> made = puffs(3);
    Outcome out;
    WorldHandle world;
    auto none = particles_of(made);
    none.count = 0;
    REQUIRE(world_of(scene, none, out, world) == PILEUS_OK);
    const std::string empty = hash_by(scene, world);
    auto one = particles_of(made);
    one.count = 1;
    one.density = nullptr, one.id = nullptr;
    one.position_stride = one.radius_stride = 0;
    REQUIRE(world_of(scene, one, out, world) == PILEUS_OK);
    CHECK(hash_by(scene, world) != empty);

    const auto refused = [&](const pileus_particles& given, const char* line,
                             std::uint32_t medium = 0) {
        CHECK(world_of(scene, given, out, world, medium) == PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(out.line().find(line) != std::string::npos, out.line());
        CHECK(world == nullptr);
    };
    auto given = particles_of(made);
    given.position = nullptr;
    refused(given, "densities[0]: position: null");
    given = particles_of(made);
    given.radius_stride = 3;
    refused(given, "densities[0]: radius_stride: 3, allowed: at least 4");
    given = particles_of(made);
    given.struct_size = 0;
    refused(given, "particles");
    given = particles_of(made);
    given.radius = nullptr;
    refused(given, "radius");
    refused(particles_of(made), "no medium 1", 1);
    made[1].radius = -1;
    refused(particles_of(made), "particle 1: radius: out of range");
    made[1].radius = 1;
    made[2].position[1] = std::numeric_limits<float>::quiet_NaN();
    refused(particles_of(made), "particle 2: y: out of range");
    const SceneHandle box = scene_of(
        "[camera]\nposition_m = [0, -300, 50]\ntarget_m = [0, 0, 50]\n[[medium]]\n"
        "density = \"uniform:box\"\nbounds_m = [[0, 0, 0], [1, 1, 1]]\nextinction_per_m = 1\n",
        {});
    CHECK(world_of(box, particles_of(puffs(3)), out, world) == PILEUS_ERROR_INPUT);
    CHECK(out.line().find("no file of particles") != std::string::npos);
}

TEST_CASE("pileus.hpp: particles of the caller") {
    const std::vector<Puff> made = puffs(40);
    pileus::embed::Particles given;
    given.count = made.size();
    given.position = made[0].position, given.position_stride = sizeof(Puff);
    given.radius = &made[0].radius, given.radius_stride = sizeof(Puff);
    auto parsed =
        pileus::embed::Scene::parse(scene_text("none.csv", ""), {}, {"method.name=\"particles\""});
    REQUIRE(bool(parsed));
    const pileus::embed::Scene scene = *std::move(parsed);
    pileus::embed::Density density;
    density.particles = &given;
    CHECK(bool(pileus::embed::World::create(scene, {}, {density})));
    given.count = 41;
    given.radius = nullptr;
    CHECK(pileus::embed::World::create(scene, {}, {density}).code() ==
          pileus::embed::Code::kBadInput);
}
