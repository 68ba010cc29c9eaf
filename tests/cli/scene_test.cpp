// SPDX-License-Identifier: Apache-2.0
// Sound scenes give the values they state; defaults, overrides and limits hold.
// in: scene texts, assets/scenes -> out: fields of Scene.
// docs/scene.md.
#include "src/scene/scene.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "src/scene/checks/check_keys.h"
#include "src/scene/read_scene.h"
#include "tests/support/keys_text.h"

namespace {

using namespace pileus;

const std::string kCamera = "[camera]\nposition_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n";

Scene good(const std::string& text, const std::vector<std::string>& overrides = {}) {
    Scene scene;
    const Status status = read_scene_text(text, "s.toml", "dir", overrides, scene);
    CHECK_MESSAGE(bool(status), status.message);
    return scene;
}

const char* const kFullScene = R"(
seed = 9_223_372_036_854_775_807
[camera]
position_m = [1, -2.5, 3]
target_m = [4, 5, 6]
projection = "orthographic"
height_m = 77
resolution = [16, 9]
[sun]
irradiance = [2, 3, 4]
[sky]
map = "a.PFM"
map_rotation_deg = -20
[[medium]]
density = "procedural:cumulus"
bounds_m = [[0, 0, 0], [1, 2, 3]]
extinction_per_m = 0.05
phase = { type = "henyey-greenstein", g = -1 }
[[medium]]
density = { file = "a.dat", type = "uint16", size = [7, 8, 9], endian = "big" }
bounds_m = [[0, 0, 0], [1, 1, 1]]
extinction_per_m = 1e12
[[medium]]
density = { file = "d.vdb", grid = "fog" }
extinction_per_m = 1
phase = { type = "cloud", cloud = "fog" }
[collectors]
photons = 2e6
tracking = "global"
closure = "lobe"
[raymarch]
scattering = "octaves"
[particles]
bins = 7
[output]
files = ["x.exr", "y.pfm"]
layers = ["radiance", "depth", "order"]
[animation]
frames = 12
camera_orbit_deg = [0, 90]
)";

TEST_CASE("a small scene has the defaults, and absent tables are absent") {
    const Scene scene = good(kCamera);
    Scene expected;
    expected.camera.position_m = {0, -9, 5};
    expected.camera.target_m = {0, 0, 5};
    CHECK(dump_scene(scene) == dump_scene(expected));
    CHECK_FALSE(scene.sun.present);
    CHECK_FALSE(scene.ground.present);
    CHECK(good(kCamera + "[sun]\n[sky]\n[ground]\n[animation]\n").sun.present);
}

TEST_CASE("a full scene gives what it says, colours in both forms, and what a file brings") {
    const Scene scene = good(kFullScene);
    CHECK(scene.text == kFullScene);
    CHECK(scene.file == "s.toml");
    CHECK(scene.directory == "dir");
    CHECK(scene.camera.orthographic);
    CHECK_FALSE(scene.camera.flux);
    CHECK(scene.camera.height_m == 77);
    CHECK(scene.camera.resolution == std::array<int, 2>{16, 9});
    CHECK(scene.sun.irradiance == Float3{2, 3, 4});
    CHECK(scene.view_files.sky_map == "a.PFM");
    CHECK(scene.sky.map_rotation_deg == -20);
    REQUIRE(scene.media.size() == 3);
    CHECK(scene.media[0].optics.phase.type == "henyey-greenstein");
    CHECK(scene.media[0].optics.phase.numbers.at("g") == -1);
    CHECK(scene.media[1].density.empty());
    CHECK(scene.media[1].source.file == "a.dat");
    CHECK(scene.media[1].source.format == "raw");
    CHECK(scene.media[1].source.raw_type == RawType::kUint16);
    CHECK(scene.media[1].source.raw_big_endian);
    CHECK(scene.media[2].source.format == "openvdb");
    CHECK(scene.media[2].source.grid == "fog");
    CHECK(scene.media[2].optics.phase.type == "cloud");
    CHECK(scene.media[2].optics.phase.numbers.at("effective_radius_um") == 10.7);
    CHECK(scene.collectors.photons == 2000000);
    CHECK_FALSE(scene.collectors.local_tracking);
    CHECK(scene.collectors.closure.lobe);
    CHECK_FALSE(scene.collectors.closure.camera);
    CHECK(scene.raymarch.scattering.many);
    CHECK(scene.output.layer_order);
    CHECK(scene.output.files == std::vector<std::string>{"x.exr", "y.pfm"});
    CHECK(scene.animation.moves_camera);
    CHECK_FALSE(scene.animation.moves_sun);
    CHECK(good(kCamera + "[[solid]]\nfile = \"a.GLB\"\n").solids[0].y_up);
    CHECK(good(kCamera + "[sky]\nradiance = 0.25\n").sky.radiance == Float3{0.25f, 0.25f, 0.25f});
}

TEST_CASE("the paper's variant changes three defaults, only where the keys are not given") {
    const CollectorSettings best = good(kCamera).collectors;
    CHECK_FALSE(best.display.billboards);
    CHECK_FALSE(best.placement.rejection_sampler);
    CHECK(best.first_order_split);
    const CollectorSettings paper = good(kCamera, {"collectors.variant=paper"}).collectors;
    CHECK(paper.display.billboards);
    CHECK(paper.placement.rejection_sampler);
    CHECK_FALSE(paper.first_order_split);
    CHECK(paper.closure.bands == best.closure.bands);
    const CollectorSettings mixed =
        good(kCamera + "[collectors]\nvariant = \"paper\"\nfirst_order_split = true\n",
             {"collectors.display=march"})
            .collectors;
    CHECK_FALSE(mixed.display.billboards);
    CHECK(mixed.placement.rejection_sampler);
    CHECK(mixed.first_order_split);
}

TEST_CASE("overrides change, add and create") {
    const Scene scene =
        good(kCamera,
             {"camera.resolution=[160,90]", "camera.position_m.2 = 6", "sun.elevation_deg=20",
              "medium.0.density=uniform:sphere", "medium.0.extinction_per_m=0.5",
              "medium.0.bounds_m=[[0,0,0],[1,1,1]]", "medium.0.albedo=0.9",
              "medium.0.phase={type=\"henyey-greenstein\", g=0.5}", "medium.0.phase.g=0.75",
              "medium.1={density=\"a.pbrt\", extinction_per_m=1}", "output.layers=[depth,error]",
              "output.files=[out/a.png, \"b.exr\"]", "output.report=", "seed=1", "seed=2",
              "collectors.photons=1_000", "raymarch.steps=3"});
    CHECK(scene.camera.resolution == std::array<int, 2>{160, 90});
    CHECK(scene.camera.position_m == Double3{0, -9, 6});
    CHECK(scene.sun.present);
    CHECK(scene.sun.elevation_deg == 20);
    CHECK(scene.raymarch.march.steps == 3);
    REQUIRE(scene.media.size() == 2);
    CHECK(scene.media[0].density == "uniform:sphere");
    CHECK(scene.media[0].optics.albedo == Float3{0.9f, 0.9f, 0.9f});
    CHECK(scene.media[0].optics.phase.numbers.at("g") == 0.75);
    CHECK(scene.media[1].source.file == "a.pbrt");
    CHECK(scene.output.layer_depth);
    CHECK(scene.output.layer_error);
    CHECK_FALSE(scene.output.layer_cloud);
    CHECK(scene.output.files == std::vector<std::string>{"out/a.png", "b.exr"});
    CHECK(scene.seed == 2);
    CHECK(scene.collectors.photons == 1000);
    CHECK(good(kCamera, {"collectors.closure=camera"}).collectors.closure.camera);
    // The text stored in pictures makes them again: what was set is added as comments.
    CHECK(scene.text.substr(0, kCamera.size()) == kCamera);
    CHECK(scene.text.find("\n# --set collectors.photons=1_000") != std::string::npos);
    CHECK(good(kCamera, {}).text == kCamera);
}

TEST_CASE("suggestions stay near the name") {
    CHECK(nearest_name("azimut_deg", {"azimuth_deg", "elevation_deg"}) == "azimuth_deg");
    CHECK(nearest_name("colectorz", {"camera", "collectors"}) == "collectors");
    CHECK(nearest_name("zebra", {"camera", "sun"}).empty());
    CHECK(nearest_name("a", {"g1"}).empty());
}

TEST_CASE("paths in a scene start at its folder") {
    CHECK(scene_path("a/b", "c.raw") == "a/b/c.raw");
    CHECK(scene_path("a/", "c.raw") == "a/c.raw");
    CHECK(scene_path("", "c.raw") == "c.raw");
    CHECK(scene_path("a", "/c.raw") == "/c.raw");
}

TEST_CASE("files: missing, a folder, too long, and sound") {
    Scene scene;
    scene.seed = 99;
    const Status missing = read_scene_file("no/such.toml", {}, scene);
    CHECK(missing.code == Code::kBadInput);
    CHECK(missing.message == "no/such.toml: no such file, allowed: a readable TOML file");
    CHECK(read_scene_file("/", {}, scene).code == Code::kBadInput);
    CHECK(read_scene_text(kCamera + "x = 1", "s", "", {}, scene).code == Code::kBadInput);
    CHECK(scene.seed == 99);
    const std::string path = "/tmp/pileus_scene_test_" + std::to_string(getpid()) + ".toml";
    std::ofstream(path) << kCamera << '#' << std::string(kMaxSceneBytes, 'x');
    CHECK(read_scene_file(path, {}, scene).code == Code::kLimit);
    std::ofstream(path) << kCamera;
    CHECK(bool(read_scene_file(path, {"seed=3"}, scene)));
    std::remove(path.c_str());
    CHECK(scene.seed == 3);
    CHECK(scene.file == path);
    CHECK(scene.directory == "/tmp");
}

TEST_CASE("the scenes in assets are sound") {
    Scene cumulus;
    const Status read = read_scene_file("assets/scenes/cumulus.toml", {}, cumulus);
    CHECK_MESSAGE(bool(read), read.message);
    REQUIRE(cumulus.media.size() == 1);
    CHECK(cumulus.media[0].box.resolution == std::array<int, 3>{160, 160, 110});
    CHECK(cumulus.media[0].box.bounds_m[1] == Double3{800, 800, 1700});
    CHECK(cumulus.media[0].optics.phase.numbers.at("g") == 0.85);
    CHECK(cumulus.output.files ==
          std::vector<std::string>{"../../out/cumulus.png", "../../out/cumulus.exr"});
    const char* before = std::getenv("PILEUS_DATA_DIR");
    if (before == nullptr) setenv("PILEUS_DATA_DIR", "/data", 1);
    for (const char* name : {"assets/scenes/smoke_day.toml", "assets/scenes/smoke_evening.toml"}) {
        Scene scene;
        const Status status = read_scene_file(name, {}, scene);
        CHECK_MESSAGE(bool(status), status.message);
        REQUIRE(scene.media.size() == 1);
        CHECK(scene.media[0].source.y_up);
        CHECK(scene.media[0].source.format == "pbrt");
    }
    for (const char* name : {"assets/scenes/rico.toml", "assets/scenes/stratocumulus.toml"}) {
        Scene scene;
        const Status status = read_scene_file(name, {}, scene);
        CHECK_MESSAGE(bool(status), status.message);
        REQUIRE(scene.media.size() == 1);
        CHECK(scene.media[0].source.format == "les");
        CHECK(scene.media[0].optics.extinction_scale == 1);
    }
    if (before == nullptr) unsetenv("PILEUS_DATA_DIR");
}

}  // namespace
