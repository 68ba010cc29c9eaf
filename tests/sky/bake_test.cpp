// SPDX-License-Identifier: Apache-2.0
// Skies on grids: the field's own values, periods, nothing at coverage 0, and scenes' faults.
// in: media and scene texts -> out: pass or fail.
#include <cmath>
#include <string>

#include "kernels_cpu/procedural/sky_field.h"
#include "src/scene/read_scene.h"
#include "tests/sky/sky_rig.h"

using namespace sky_test;

namespace {

MediumSettings medium() {
    MediumSettings m;
    m.density = "procedural:sky";
    m.sky = small_sky();
    m.box.bounds_m = {Double3{-4096, 512, 900}, Double3{4096, 4608, 2600}};
    m.box.resolution = {37, 20, 11};
    return m;
}

Volume baked(const MediumSettings& m, const KernelTable* table = nullptr, int threads = 2) {
    unsetenv("HOME"), unsetenv("PILEUS_CACHE_DIR"), unsetenv("XDG_CACHE_HOME");
    Volume volume;
    if (table == nullptr) table = kernel_table(nullptr);
    REQUIRE(bake_sky(m, m.box.resolution, *table, threads, volume));
    return volume;
}

bool equal(const Volume& a, const Volume& b) {
    REQUIRE(a.density.size() == b.density.size());
    for (std::size_t i = 0; i < a.density.size(); ++i)
        if (a.density[i] != b.density[i]) return false;
    return true;
}

const std::string kScene =
    "[camera]\nposition_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n[[medium]]\n"
    "density = \"procedural:sky\"\nbounds_m = [[0, 0, 900], [4000, 6000, 2000]]\n";

Status read(const std::string& lines, Scene& scene) {
    return read_scene_text(kScene + lines, "s.toml", "", {}, scene);
}
std::string fault(const std::string& lines) {
    Scene scene;
    const Status status = read(lines, scene);
    CHECK(status.code == Code::kBadInput);
    return status.message;
}

}  // namespace

TEST_CASE("cells hold the field at their middles, whatever the kernels and threads") {
    const MediumSettings m = medium();
    const Volume volume = baked(m);
    const Rig rig(m.sky, m.box.bounds_m[0], true);
    int cloudy = 0;
    const float cell[3] = {float(8192.0 / 37), float(4096.0 / 20), float(1700.0 / 11)};
    for (int z = 0; z < 11; ++z)
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 37; ++x) {
                const Vec<float> p{(float(x) + 0.5f) * cell[0], (float(y) + 0.5f) * cell[1],
                                   (float(z) + 0.5f) * cell[2]};
                const float v = volume.density[std::size_t((z * 20 + y) * 37 + x)];
                CHECK(v == sky_density(rig.params(), p, cell[0]));
                cloudy += v > 0 ? 1 : 0;
            }
    CHECK(cloudy > 100);
    for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i)
        CHECK(equal(baked(m, table, 1 + i), volume));
}

TEST_CASE("a box moved by whole tiles holds the same") {
    MediumSettings m = medium();
    m.sky.worley.tile_m = 2048;
    const Volume here = baked(m);
    m.box.bounds_m[0][0] += 4096 * 3, m.box.bounds_m[1][0] += 4096 * 3;
    m.box.bounds_m[0][1] -= 4096, m.box.bounds_m[1][1] -= 4096;
    CHECK(equal(baked(m), here));
    m.box.bounds_m[0][0] += 100, m.box.bounds_m[1][0] += 100;
    CHECK(!equal(baked(m), here));
}

TEST_CASE("a box left out of its resolution has cubes") {
    MediumSettings m = medium();
    m.box.resolution = {0, 0, 0};
    CHECK(default_sky_size(m) == std::array<int, 3>{256, 128, 54});
}

TEST_CASE("a kind of cloud brings layer, extinction and droplets, and the scene wins") {
    Scene scene;
    REQUIRE(read("sky = { type = \"stratus\", base_m = 450 }\n", scene));
    const MediumSettings& m = scene.media[0];
    CHECK(m.sky.base_m == 450);
    CHECK(m.sky.top_m == 800);
    CHECK(m.sky.coverage == 0.95);
    CHECK(m.optics.extinction_per_m == 0.057);
    CHECK(m.optics.phase.type == "cloud");
    CHECK(m.optics.phase.numbers.at("effective_radius_um") == 7.33);
    REQUIRE(
        read("extinction_per_m = 0.5\nphase = { type = \"rayleigh\" }\n"
             "sky = { type = \"stratus\", threshold_low = 0.2 }\n",
             scene));
    CHECK(scene.media[0].optics.extinction_per_m == 0.5);
    CHECK(scene.media[0].optics.phase.type == "rayleigh");
    CHECK(scene.media[0].sky.coverage == -1);  // thresholds that are given stay
    REQUIRE(read("extinction_per_m = 1\n", scene));
    CHECK(scene.media[0].sky.threshold_high == 0.7);
}

TEST_CASE("faults of a sky are one clear line each") {
    const std::string ext = "extinction_per_m = 1\n";
    CHECK(fault("sky = { type = \"cumulonimbis\" }\n").find("unknown value") != std::string::npos);
    CHECK(fault("sky = { perlin_m = 100 }\n").find("extinction_per_m: missing") !=
          std::string::npos);
    CHECK(fault(ext + "sky = { threshold_low = 0.7, threshold_high = 0.6 }\n") ==
          "s.toml:8:47: medium.0.sky.threshold_high: not above threshold_low, 0.6, allowed: more "
          "than 0.7");
    CHECK(fault(ext + "sky = { base_m = 5000 }\n").find("medium.0.sky.top_m: not above base_m") !=
          std::string::npos);
    CHECK(fault(ext + "sky = { size = 100 }\n") ==
          "s.toml:8:16: medium.0.sky.size: not a power of two, 100, allowed: 16, 32, 64, 128, 256, "
          "512");
    CHECK(fault(ext + "sky = { worley_cells = 40, octaves = 2 }\n").find("too fine") !=
          std::string::npos);
    CHECK(fault(ext + "sky = { blend = 1, gain_perlin = 0 }\n").find("no noise is left") !=
          std::string::npos);
    CHECK(fault(ext + "sky = { planet_radius_m = 300 }\n").find("too small") != std::string::npos);
    CHECK(fault(ext + "boundary = \"periodic\"\nsky = { perlin_m = 2000, worley_m = 1500 }\n") ==
          "s.toml:9:37: medium.0.sky.worley_m: does not divide the box of boundary \"periodic\", "
          "1500 m, allowed: 4000 m over a whole number");
    CHECK(fault(ext + "sky = { coverage = 1.5 }\n").find("out of range") != std::string::npos);
    CHECK(fault(ext + "shape_seed = 3\n").find("shape_seed: for procedural:cumulus") !=
          std::string::npos);
    Scene scene;
    const Status status = read_scene_text(
        "[camera]\nposition_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n[[medium]]\ndensity = "
        "\"uniform:box\"\nbounds_m = [[0, 0, 0], [1, 1, 1]]\nextinction_per_m = 1\nsky = { seed = "
        "1 "
        "}\n",
        "s.toml", "", {}, scene);
    CHECK(status.message.find("for procedural:sky only") != std::string::npos);
    REQUIRE(
        read(ext + "boundary = \"periodic\"\nsky = { perlin_m = 2000, worley_m = 1000 }\n", scene));
}
