// SPDX-License-Identifier: Apache-2.0
// Solids in the light of clouds: the ledger's fate, shadows in every method, agreement with paths.
// in: plates in and before a box of medium -> out: pass or fail.
// docs/solids.md, "Shadows in clouds".
#include "src/picture/nodes/solid_shadow.h"

#include <cmath>

#include "tests/support/plate_world.h"
#include "tests/support/solid_harness.h"

using namespace render_test;
using namespace plate_test;

namespace {

/// Before the northern half of the box, across the sunlight.
constexpr const char* kBefore =
    "position_m = [0, 22, 20]\nrotation_deg = [-45, 0, 0]\nscale = 3\nalbedo = 0";

}  // namespace

TEST_CASE("solid shadow: on nodes, whole, half and none") {
    TestMesh mesh;
    mesh.add({0, 0, 5}, {9, 0, 5}, {9, 9, 5});
    mesh.add({0, 0, 5}, {9, 9, 5}, {0, 9, 5});
    const Solids solids = make_solids(mesh);
    NodeGrid nodes{{4, 1, 1}, {1, 1, 1}};
    Report report;
    Context context;
    context.report = &report;
    Buffer<float> seen;
    REQUIRE(solid_visibility(context, solids, nodes, {0, 0, 1}, seen));
    for (float v : seen.span()) CHECK(v == 0.0f);
    REQUIRE(solid_visibility(context, solids, nodes, {0, 0, -1}, seen));
    for (float v : seen.span()) CHECK(v == 1.0f);
    // The edge at x = 0, moved by a ray that climbs 5 m while it goes 1 m to the west.
    const float length = std::sqrt(26.0f);
    nodes.per_metre[0] = 0.5f;
    REQUIRE(solid_visibility(context, solids, nodes, {-1 / length, 0, 5 / length}, seen));
    CHECK(seen[0] == 0.5f);
    CHECK(seen[1] == 0.0f);
    Solids none;
    Buffer<float> empty;
    REQUIRE(solid_visibility(context, none, nodes, {0, 0, 1}, empty));
    CHECK(empty.empty());
}

TEST_CASE("solid shadow: a photon's power has one fate more, and every quantum one fate") {
    const Files files;
    const char* grey = "extinction_per_m = 0.25\nalbedo = 0.75\n";
    const char* colours = "extinction_per_m = 0.25\nalbedo = [0.5, 0.75, 1]\n";
    const char* sky = "[sky]\nradiance = 0.25\n";
    const std::string lights = std::string(kSun) + sky;
    for (const char* medium : {grey, colours})
        for (const char* albedo : {"albedo = 0", "albedo = [0.25, 0.5, 1]", "albedo = 1"}) {
            const std::string plate = std::string("scale = 2\n") + albedo;
            const Picture p =
                render_one(scene_from(world(medium, lights.c_str()) + files.plate(plate.c_str()) +
                                      "[ground]\naltitude_m = -9\nalbedo = 0.5\n"));
            CHECK(p.report.photons.energy.size() >= 4);  // render_one has looked at the quanta
            for (const EnergyRow& row : p.report.photons.energy) {
                const double sum = row.top + row.bottom + row.sides + row.absorbed + row.ground +
                                   row.sky + row.terminated + row.solid;
                CHECK(sum == doctest::Approx(row.emitted).epsilon(1e-12));
                if (row.emitted > 0 && std::string(albedo) != "albedo = 1") CHECK(row.solid > 1e-3);
            }
        }
}

TEST_CASE("solid shadow: a plate before the sun leaves nothing, in any method") {
    const Files files;
    const std::string scene =
        world("extinction_per_m = 0.25\nalbedo = 0.9\n", kSun) +
        files.plate("position_m = [0, 20, 20]\nrotation_deg = [-45, 0, 0]\nscale = 30\nalbedo = 0");
    for (const char* method : {"collectors", "photon-grid", "path", "raymarch"}) {
        CAPTURE(method);
        const Picture p = render_one(scene_from(scene, {std::string("method.name=") + method}));
        for (int i = 0; i < 16; ++i) CHECK(p.at("G", i, i) == 0.0f);
    }
    const Picture p = render_one(scene_from(scene, {"collectors.display=billboards"}));
    for (int i = 0; i < 16; ++i) CHECK(p.at("G", i, i) == 0.0f);
    CHECK(p.report.photons.energy[0].solid == 1.0);
}

TEST_CASE("solid shadow: half of a thin cloud, all methods against paths") {
    const Files files;
    const std::string scene = world("extinction_per_m = 0.02\nalbedo = 1\n", kSun);
    const std::string shaded = scene + files.plate(kBefore);
    const auto halves = [&](const std::string& text, const char* method) {
        const Picture p = render_one(scene_from(text, {std::string("method.name=") + method}));
        return std::pair{mean_of(p, 0, 8), mean_of(p, 8, 16)};
    };
    const auto path = halves(shaded, "path"), free = halves(scene, "path");
    CHECK(path.first < 0.6 * free.first);  // the test has a shadow to look at
    for (const char* method : {"collectors", "raymarch"}) {
        CAPTURE(method);
        const auto got = halves(shaded, method), bare = halves(scene, method);
        // Nodes of two voxels, one order of scattering in raymarch: shadows compared as shares.
        CHECK(got.first / bare.first == doctest::Approx(path.first / free.first).epsilon(0.06));
        CHECK(got.second / bare.second == doctest::Approx(path.second / free.second).epsilon(0.06));
    }
}

TEST_CASE("solid shadow: a white plate in a white cloud in an even sky") {
    const Files files;
    const std::string scene =
        world("extinction_per_m = 0.5\nalbedo = 1\n", "[sky]\nradiance = 0.5\n") +
        files.plate("scale = 3\nalbedo = 1");
    const Picture p = render_one(scene_from(scene));
    for (const LeftOut& l : p.report.plan.left_out) CHECK(l.what != "sky photons");
    CHECK(mean_of(p, 0, 16) == doctest::Approx(0.5).epsilon(0.03));
    // A black one takes its share of the light.
    const Picture black = render_one(scene_from(scene, {"solid.0.albedo=0"}));
    CHECK(mean_of(black, 0, 16) < 0.45);
    const Picture path = render_one(scene_from(scene, {"solid.0.albedo=0", "method.name=path"}));
    CHECK(mean_of(black, 0, 16) == doctest::Approx(mean_of(path, 0, 16)).epsilon(0.06));
}
