// SPDX-License-Identifier: Apache-2.0
// Solids that repeat with a periodic medium: the same as copies side by side, in every method.
// in: meshes, rays, pictures of one period -> out: pass or fail.
// docs/solids.md, "In periodic media".
#include <cmath>

#include "kernels_cpu/solids/solids.h"
#include "src/io/images/image_file.h"
#include "tests/support/plate_world.h"
#include "tests/support/solid_harness.h"

using namespace render_test;
using namespace plate_test;

namespace {

/// A ramp and a wall within 8 x 6 metres, copies of them moved by whole periods of 8 x 10.
TestMesh ramp(int from, int to) {
    TestMesh mesh;
    for (int i = from; i <= to; ++i)
        for (int j = from; j <= to; ++j) {
            const float x = float(8 * i), y = float(10 * j);
            mesh.add({x, y, 0}, {x + 8, y, 0}, {x + 8, y + 6, 3});
            mesh.add({x, y, 0}, {x + 8, y + 6, 3}, {x, y + 6, 3});
            mesh.add({x + 2, y + 1, 0}, {x + 2, y + 5, 0}, {x + 2, y + 3, 7});
        }
    return mesh;
}

constexpr const char* kThin = "boundary = \"periodic\"\nextinction_per_m = 0.02\nalbedo = 1\n";

}  // namespace

TEST_CASE("periodic solids: a ray finds what it finds among copies side by side") {
    Solids one = make_solids(ramp(0, 0));
    one.period[0] = 8, one.period[1] = 10;
    const Solids many = make_solids(ramp(-12, 12));
    Luck luck(7);
    int found = 0, missed = 0;
    for (int n = 0; n < 20000; ++n) {
        const Float3 o{luck.both_ways(40), luck.both_ways(40), 4 + luck.both_ways(5)};
        Float3 d = luck.place(1);
        // Some straight along an axis, which meet the faces of cells at right angles.
        if (n % 8 == 0) d = {n % 16 == 0 ? 1.0f : 0.0f, n % 16 == 0 ? 0.0f : -1.0f, 0};
        const float length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const float from[3] = {o[0], o[1], o[2]},
                    along[3] = {d[0] / length, d[1] / length, d[2] / length};
        float there = 0, here = 0;
        const std::int32_t a = nearest_solid(many.view(), from, along, 50.0f, there);
        const std::int32_t b = nearest_solid(one.view(), from, along, 50.0f, here);
        CHECK(solid_between(one.view(), from, along, 50.0f) == (b >= 0));
        // A ray that grazes an edge may be on either side of it by rounding: none here does.
        CHECK((a >= 0) == (b >= 0));
        if (a < 0 || b < 0) {
            ++missed;
            continue;
        }
        ++found;
        // Places within 100 m of floats, moved by periods: some roundings of 2^-18 m, seen flat.
        CHECK(std::fabs(here - there) < 2e-3f);
    }
    CHECK(found > 5000);
    CHECK(missed > 1000);
}

TEST_CASE("periodic solids: level rays end, and far copies are as sharp as near ones") {
    Solids one = make_solids(ramp(0, 0));
    one.period[0] = 8, one.period[1] = 10;
    float way = 0;
    const float gap[3] = {1, 8, 1}, level[3] = {1, 0, 0};  // between the ramps
    CHECK(nearest_solid(one.view(), gap, level, 3e38f, way) == -1);
    // The wall of copy 1000 in y, from just before it.
    const float before[3] = {1, 10003, 5}, east[3] = {1, 0, 0};
    REQUIRE(nearest_solid(one.view(), before, east, 3e38f, way) >= 0);
    CHECK(way == doctest::Approx(1).epsilon(1e-5));
    // Straight down on the ramp, a thousand periods away on both sides.
    for (const float x : {-7997.0f, 8003.0f}) {
        const float above[3] = {x, 10002, 10}, down[3] = {0, 0, -1};
        REQUIRE(nearest_solid(one.view(), above, down, 3e38f, way) >= 0);
        CHECK(way == doctest::Approx(9).epsilon(1e-5));
    }
    // Beyond what floats tell apart nothing is found, and nothing runs on.
    const float nowhere[3] = {1e30f, 0, 10}, slant[3] = {0, 0, -1};
    CHECK(nearest_solid(one.view(), nowhere, slant, 3e38f, way) == -1);
}

TEST_CASE("periodic solids: a plate before the sun shades in every method, its copies too") {
    // A plate of 4 x 4 m above a quarter of a period, but placed three periods away.
    const Files files;
    const std::string flat = files.plate("position_m = [24, 13, 9]\nscale = 2\nalbedo = 0");
    const std::string lit = world(kThin, kSun), dark = lit + flat;
    for (const char* method : {"path", "collectors", "photon-grid", "raymarch"}) {
        CAPTURE(method);
        const std::string set = std::string("method.name=") + method;
        const Picture with = render_one(scene_from(dark, {set})),
                      without = render_one(scene_from(lit, {set}));
        // The plate of 4 x 4 m hides a quarter of every period's sunlight. Seen from above it is
        // black before a quarter of the picture, too: of what is beside it the medium below the
        // plate's shadow, a quarter, is dark but for what is scattered twice (0.16 of depth).
        double a = 0, b = 0;
        int n = 0;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                if (with.at("A", x, y) == 0.0f) continue;
                a += double(with.at("G", x, y)), b += double(without.at("G", x, y)), ++n;
            }
        CHECK(n == 192);
        CHECK(a / b > 0.65);
        CHECK(a / b < 0.85);
    }
}

TEST_CASE("periodic solids: white ones in a white medium in an even sky cannot be seen") {
    // Conservation: what comes from everywhere alike goes everywhere alike.
    const Files files;
    const std::string text = world("boundary = \"periodic\"\nextinction_per_m = 0.2\nalbedo = 1\n",
                                   "[sky]\nradiance = 0.5\n[ground]\nalbedo = 1\n"
                                   "altitude_m = -6\n") +
                             files.plate(
                                 "position_m = [3, 1, 0]\nrotation_deg = [30, 40, 0]\n"
                                 "scale = 2.5\nalbedo = 1");
    const Picture p =
        render_one(scene_from(text, {"method.name=path", "path.samples_per_pixel=1024",
                                     "output.layers=[\"radiance\",\"alpha\",\"error\"]"}));
    double sum = 0, variance = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            sum += double(p.at("G", x, y)) / 256;
            variance += std::pow(double(p.at("error.G", x, y)) / 256, 2);
        }
    CAPTURE(sum);
    CHECK(std::fabs(sum - 0.5) <= 4 * std::sqrt(variance) + 1e-5);
}

TEST_CASE("periodic solids: photons and paths agree on a tilted grey plate in the medium") {
    const Files files;
    const std::string text =
        world("boundary = \"periodic\"\nextinction_per_m = 0.1\nalbedo = 0.9\n", kSun) +
        files.plate("position_m = [7, 0, 1]\nrotation_deg = [25, 0, 0]\nscale = 2\nalbedo = 0.6");
    const double paths = mean_of(render_one(scene_from(text, {"method.name=path"})), 0, 16);
    for (const char* method : {"collectors", "photon-grid"}) {
        CAPTURE(method);
        const Picture p = render_one(scene_from(text, {std::string("method.name=") + method}));
        // 2.5 %: nodes a quarter of a metre apart blur the plate's shadow; half of it is measured.
        CHECK(mean_of(p, 0, 16) == doctest::Approx(paths).epsilon(0.025));
        double solid = 0;
        for (const EnergyRow& row : p.report.photons.energy) {
            CHECK(row.sides == 0);
            solid += row.solid;
        }
        CHECK(solid > 0.01);
    }
}

TEST_CASE("periodic solids: a depth image ends rays that have passed sides of periods") {
    // An even sky around a white layer: what rays meet before their end shines like the sky.
    const test::TempFolder folder;
    const std::string path = folder.path("depth.exr");
    Image depth;
    depth.width = depth.height = 4;
    depth.channels.resize(1);
    depth.channels[0].name = "Z";
    REQUIRE(depth.channels[0].pixels.resize(16, "depth"));
    for (std::size_t i = 0; i < 16; ++i) depth.channels[0].pixels[i] = i < 8 ? 50.0f : 3.0f;
    REQUIRE(write_image(depth, path, ToneSettings()));
    for (const char* place : {"[0.5, 0.25, 0.125]", "[940.5, -39.75, 0.125]"}) {
        CAPTURE(place);
        const std::string text = std::string("seed = 3\n[camera]\nposition_m = ") + place +
                                 "\nfov_deg = 0.01\nresolution = [4, 4]\ndepth = \"" + path +
                                 "\"\n" + R"(
target_m = [1000, 100, 0]
[path]
samples_per_pixel = 512
[method]
name = "path"
[output]
layers = ["radiance", "alpha", "error"]
[sky]
radiance = 0.5
[[medium]]
density = "uniform:box"
boundary = "periodic"
bounds_m = [[-4, -4, -4], [4, 4, 4]]
resolution = [8, 8, 8]
extinction_per_m = 0.02
albedo = 1
)";
        const Picture p = render_one(scene_from(text));
        for (int y = 0; y < 4; ++y) {
            const double seen = 1 - std::exp(-0.02 * (y < 2 ? 50 : 3));
            CHECK(p.at("A", 0, y) == doctest::Approx(seen).epsilon(1e-3));
            for (int x = 0; x < 4; ++x)
                CHECK(std::fabs(double(p.at("G", x, y)) - 0.5 * seen) <
                      4.5 * double(p.at("error.G", x, y)));
        }
    }
}

TEST_CASE("periodic solids: wider than a period is refused in a line") {
    const Files files;
    const Scene scene = scene_from(world(kThin, kSun) + files.plate("scale = 4.01"));
    const Status status =
        render(scene, RenderOptions(), [](int, Image&, Report&) { return Status::ok(); });
    CHECK(!status);
    CHECK(status.message.find("allowed: at most a period of the medium, 8 m") != std::string::npos);
    // Exactly as wide is a floor without gaps.
    const Picture floor = render_one(
        scene_from(world(kThin, kSun) + files.plate("position_m = [1, 2, -4.5]\nscale = 4"),
                   {"method.name=path"}));
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            CHECK(floor.at("A", x, y) < 1);
            CHECK(floor.at("G", x, y) > 0.03f);  // the medium alone: 0.013
        }
}
