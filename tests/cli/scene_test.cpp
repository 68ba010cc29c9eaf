// SPDX-License-Identifier: Apache-2.0
// Sound scenes give the values they state; defaults, overrides, documentation and limits hold.
// in: scene texts, assets/scenes, docs/scene.md -> out: fields of Scene.
// docs/scene.md.
#include "src/scene/scene.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "src/scene/check_keys.h"
#include "src/scene/read_scene.h"
#include "src/scene/scene_keys.h"
#include "tests/support/scene_dump.h"

namespace {

using namespace pileus;
using test::dump;

const std::string kCamera = "[camera]\nposition_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n";

Scene good(const std::string& text, const std::vector<std::string>& overrides = {}) {
    Scene scene;
    const Status status = read_scene_text(text, "s.toml", "dir", overrides, scene);
    CHECK_MESSAGE(bool(status), status.message);
    return scene;
}

std::string file_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

const char* const kEveryKey = R"(
seed = 9_223_372_036_854_775_807
[camera]
position_m = [1, -2.5, 3]
target_m = [4, 5, 6]
up = [0, 1, 0]
projection = "orthographic"
height_m = 77
resolution = [16, 9]
[sun]
azimuth_deg = 120
elevation_deg = 35
irradiance = [2, 3, 4]
[sky]
map = "a.PFM"
map_scale = 2
map_rotation_deg = -20
[ground]
altitude_m = -10
albedo = 0.5
[[solid]]
file = "a.ply"
albedo = [0.25, 0.5, 0.75]
position_m = [1, 2, 3]
scale = 4
rotation_deg = [5, 6, 7]
y_up = true
[[medium]]
density = "procedural:cumulus"
bounds_m = [[0, 0, 0], [1, 2, 3]]
resolution = [3, 4, 5]
shape_seed = 8
extinction_per_m = 0.05
albedo = [0.1, 0.2, 0.3]
phase = { type = "henyey-greenstein", g = -1 }
boundary = "open"
y_up = false
[[medium]]
density = { file = "a.dat", type = "uint16", size = [7, 8, 9], endian = "big" }
bounds_m = [[0, 0, 0], [1, 1, 1]]
extinction_per_m = 1e12
phase = { type = "two-lobe", g1 = 1, g2 = -0.5, weight = 0.75 }
y_up = true
[[medium]]
density = "b.txt"
format = "pbrt"
extinction_per_m = 0
phase = { type = "rayleigh" }
[[medium]]
density = "c.txt"
extinction_scale = 2.5
phase = { type = "hg-draine", droplet_diameter_um = 20.5 }
[[medium]]
density = "c.vdb"
grid = "smoke"
extinction_per_m = 1
phase = { type = "cloud", cloud = "fog" }
[[medium]]
density = { file = "d.vdb", grid = "fog" }
extinction_per_m = 1
phase = { type = "cloud", effective_radius_um = 4.5 }
[method]
name = "collectors"
[collectors]
photons = 2e6
generations = 7
bands = 5
axis_degrees = 3
samples = 11
tracking = "global"
closure = "lobe"
cell_voxels = 4
variant = "paper"
display = "march"
sampler = "stratified"
placement = "variance"
variance_radius = 3
density_range = 0.5
influence_radius = 1
radius_factor = 2
first_order_split = true
window = true
accumulation = "shared"
compositor = "builtin"
[path]
samples_per_pixel = 5
max_depth = 6
pixel = "centre"
target_error = 0.5
max_samples_per_pixel = 7
[raymarch]
integrator = "simpson"
steps = 31
spacing = "geometric"
first_step_m = 1.5
growth = 1.25
occlusion = "stretch"
scattering = "forward"
cone_deg = 50
forward_share = 0.5
octaves = 3
octave_extinction = 0.25
octave_share = 0.75
octave_anisotropy = 0.5
light = "buffer"
light_steps = 4
light_first_step_m = 2.5
light_growth = 3
sky_light = "none"
detail = true
light_path = "cone"
jitter = "blue-noise"
jitter_share = 0.75
grid_lock_m = 8
powder = "directional"
powder_strength = 0.25
ambient = [1, 2, 3]
stop_below = 0.5
scale = 4
upsample = "nearest"
temporal = 2
phase = "peak"
[photon-grid]
anything = { goes = [1, 2] }
[output]
files = ["x.exr", "y.pfm"]
report = "r.json"
layers = ["radiance", "depth", "error", "cloud", "optical_depth", "transmittance", "light", "order"]
[animation]
frames = 12
camera_orbit_deg = [0, 90]
sun_elevation_deg = [35, 5]
)";

TEST_CASE("every key of a full scene reaches its field") {
    const Scene scene = good(kEveryKey);
    // No medium of this scene is a sky: sky/keys_test.
    const std::string sky = dump(SkySettings());
    const std::string expected =
        R"({9223372036854775807 {[1 -2.5 3 ] [4 5 6 ] [0 1 0 ] 1 0 40 77 [16 9 ] "" 0 1 }
{1 120 35 [2 3 4 ] }
{1 [0 0 0 ] "a.PFM" 2 -20 }
{1 -10 0.5 }
[{"a.ply" [0.25 0.5 0.75 ] [1 2 3 ] [5 6 7 ] 4 1 }
] [{0 "" "" "" 2 [0 0 0 ] 0 1 [[0 0 0 ] [1 2 3 ] ] [3 4 5 ] 8 )" +
        sky +
        R"(0.050000000000000003 1 [0.10000000149011612 0.20000000298023224 0.30000001192092896 ] {2 -1 0 0 1 0 0 "" }
0 0 }
{4 "a.dat" "raw" "" 1 [7 8 9 ] 1 1 [[0 0 0 ] [1 1 1 ] ] [0 0 0 ] 0 )" +
        sky + R"(1000000000000 1 [1 1 1 ] {3 0 1 -0.5 0.75 0 0 "" }
0 1 }
{4 "b.txt" "pbrt" "" 2 [0 0 0 ] 0 0 [[0 0 0 ] [0 0 0 ] ] [0 0 0 ] 0 )" +
        sky + R"(0 1 [1 1 1 ] {1 0 0 0 1 0 0 "" }
0 0 }
{4 "c.txt" "les" "" 2 [0 0 0 ] 0 0 [[0 0 0 ] [0 0 0 ] ] [0 0 0 ] 0 )" +
        sky + R"(0 2.5 [1 1 1 ] {4 0 0 0 1 20.5 0 "" }
0 0 }
{4 "c.vdb" "openvdb" "smoke" 2 [0 0 0 ] 0 0 [[0 0 0 ] [0 0 0 ] ] [0 0 0 ] 0 )" +
        sky + R"(1 1 [1 1 1 ] {5 0 0 0 1 0 10.699999999999999 "" }
0 0 }
{4 "d.vdb" "openvdb" "fog" 2 [0 0 0 ] 0 0 [[0 0 0 ] [0 0 0 ] ] [0 0 0 ] 0 )" +
        sky + R"(1 1 [1 1 1 ] {5 0 0 0 1 0 4.5 "" }
0 0 }
] "collectors" {2000000 7 5 11 0 1 0 4 1 0 0 0 1 3 0.5 1 2 3 1 1 2 }
{5 6 1 0.5 7 }
{3 31 3 1.5 1.25 1 1 0 3 0.25 0.75 0.5 50 0.5 2 4 2.5 3 0 1 1 2 0.75 8 3 0.25 [1 2 3 ] 0.5 4 2 2 1 }
{["x.exr" "y.pfm" ] "r.json" 1 1 1 1 1 1 1 }
{1 12 [0 90 ] [35 5 ] 1 1 }
}
)";
    CHECK(dump(scene) == expected);
    CHECK(scene.text == kEveryKey);
    CHECK(scene.file == "s.toml");
    CHECK(scene.directory == "dir");
    const Scene deep = good(kCamera + "depth = \"d.exr\"\ndepth_kind = \"z\"\ndepth_scale = 0.5\n");
    CHECK(deep.camera.depth == "d.exr");
    CHECK(deep.camera.depth_on_axis);
    CHECK(deep.camera.depth_scale == 0.5);
    const Scene gltf = good(kCamera + "[[solid]]\nfile = \"a.GLB\"\n");
    CHECK(gltf.solids[0].y_up);
    const Scene even = good(kCamera + "[sky]\nradiance = 0.25\n");
    CHECK(even.sky.radiance == Float3{0.25f, 0.25f, 0.25f});
    CHECK(even.sky.map.empty());
}

TEST_CASE("the full scene holds every key that sets something") {
    Node root;
    SyntaxFault fault;
    REQUIRE(parse_toml(kEveryKey, root, fault));
    Scene scene;
    FaultList faults("s.toml", {});
    SceneCheck check{scene, root, faults, {}};
    check_keys(check);
    // Excluded by the orthographic view, by the map and by the moving camera.
    std::set<std::string> seen{"camera.fov_deg", "sky.radiance", "camera.depth_kind",
                               "camera.depth_scale"};
    // Those of a procedural sky: sky/keys_test.
    for (const KeyRow& row : sky_keys()) seen.insert(row.path);
    for (const auto& [path, found] : check.found) {
        std::string pattern = path;
        if (pattern.compare(0, 7, "medium.") == 0) pattern.replace(7, 1, "N");
        if (pattern.compare(0, 6, "solid.") == 0) pattern.replace(6, 1, "N");
        seen.insert(pattern);
    }
    for (const KeyRow* row : all_scene_keys())
        if (row->set != nullptr) CHECK_MESSAGE(seen.count(row->path) == 1, row->path);
}

TEST_CASE("the defaults of the key table are those of the structs") {
    int compared = 0;
    for (const KeyRow* row : all_scene_keys()) {
        const std::string fallback = row->fallback;
        if (row->set == nullptr || fallback.empty() || fallback == kRequired) continue;
        CAPTURE(row->path);
        Node root;
        SyntaxFault fault;
        REQUIRE(parse_toml("v = " + fallback, root, fault));
        FaultList faults("table", {});
        CHECK(check_value(*row, root.children[0], row->path, faults));
        Scene scene, untouched;
        MediumSettings medium;
        SolidSettings solid;
        row->set(root.children[0], {scene, medium, solid});
        scene.media.push_back(medium);
        scene.solids.push_back(solid);
        untouched.media.emplace_back();
        untouched.solids.emplace_back();
        CHECK(dump(scene) == dump(untouched));
        ++compared;
    }
    CHECK(compared > 30);
}

TEST_CASE("a small scene has the defaults, and absent tables are absent") {
    const Scene scene = good(kCamera);
    Scene expected;
    expected.camera.position_m = {0, -9, 5};
    expected.camera.target_m = {0, 0, 5};
    CHECK(dump(scene) == dump(expected));
    CHECK_FALSE(scene.sun.present);
    CHECK_FALSE(scene.ground.present);
    CHECK(good(kCamera + "[sun]\n[sky]\n[ground]\n[animation]\n").sun.present);
}

TEST_CASE("the paper's variant changes three defaults, only where the keys are not given") {
    const CollectorSettings best = good(kCamera).collectors;
    CHECK_FALSE(best.billboards);
    CHECK_FALSE(best.rejection_sampler);
    CHECK(best.first_order_split);
    const CollectorSettings paper = good(kCamera, {"collectors.variant=paper"}).collectors;
    CHECK(paper.billboards);
    CHECK(paper.rejection_sampler);
    CHECK_FALSE(paper.first_order_split);
    CHECK(paper.bands == best.bands);
    const CollectorSettings mixed =
        good(kCamera + "[collectors]\nvariant = \"paper\"\nfirst_order_split = true\n",
             {"collectors.display=march"})
            .collectors;
    CHECK_FALSE(mixed.billboards);
    CHECK(mixed.rejection_sampler);
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
    CHECK(scene.raymarch.steps == 3);
    REQUIRE(scene.media.size() == 2);
    CHECK(scene.media[0].density == DensityKind::kUniformSphere);
    CHECK(scene.media[0].albedo == Float3{0.9f, 0.9f, 0.9f});
    CHECK(scene.media[0].phase.g == 0.75);
    CHECK(scene.media[1].file == "a.pbrt");
    CHECK(scene.output.layer_depth);
    CHECK(scene.output.layer_error);
    CHECK_FALSE(scene.output.layer_cloud);
    CHECK(scene.output.files == std::vector<std::string>{"out/a.png", "b.exr"});
    CHECK(scene.seed == 2);
    CHECK(scene.collectors.photons == 1000);
    CHECK(good(kCamera, {"collectors.closure=camera"}).collectors.camera_closure);
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
    CHECK(cumulus.media[0].resolution == std::array<int, 3>{160, 160, 110});
    CHECK(cumulus.media[0].bounds_m[1] == Double3{800, 800, 1700});
    CHECK(cumulus.media[0].phase.g == 0.85);
    CHECK(cumulus.output.files ==
          std::vector<std::string>{"../../out/cumulus.png", "../../out/cumulus.exr"});
    const char* before = std::getenv("PILEUS_DATA_DIR");
    if (before == nullptr) setenv("PILEUS_DATA_DIR", "/data", 1);
    for (const char* name : {"assets/scenes/smoke_day.toml", "assets/scenes/smoke_evening.toml"}) {
        Scene scene;
        const Status status = read_scene_file(name, {}, scene);
        CHECK_MESSAGE(bool(status), status.message);
        REQUIRE(scene.media.size() == 1);
        CHECK(scene.media[0].y_up);
        CHECK(scene.media[0].format == "pbrt");
    }
    for (const char* name : {"assets/scenes/rico.toml", "assets/scenes/stratocumulus.toml"}) {
        Scene scene;
        const Status status = read_scene_file(name, {}, scene);
        CHECK_MESSAGE(bool(status), status.message);
        REQUIRE(scene.media.size() == 1);
        CHECK(scene.media[0].format == "les");
        CHECK(scene.media[0].extinction_scale == 1);
    }
    if (before == nullptr) unsetenv("PILEUS_DATA_DIR");
}

TEST_CASE("docs/scene.md holds the key table as it is, and its example is sound") {
    const std::string text = file_text("docs/scene.md");
    const std::string begin = "<!-- keys: begin -->\n", end = "<!-- keys: end -->";
    const std::size_t from = text.find(begin), to = text.find(end);
    REQUIRE(from != std::string::npos);
    REQUIRE(to != std::string::npos);
    CHECK(text.substr(from + begin.size(), to - from - begin.size()) == describe_keys_markdown());
    std::set<std::string> paths;
    for (const KeyRow* row : all_scene_keys()) {
        CHECK_MESSAGE(paths.insert(row->path).second, row->path);
        const std::string mark = std::string("| `") + row->path + "` |";
        CHECK_MESSAGE(text.find(mark) != std::string::npos, row->path);
    }
    const std::size_t example = text.find("```toml\n");
    REQUIRE(example != std::string::npos);
    const std::size_t start = example + 8;
    good(text.substr(start, text.find("```", start) - start));
}

}  // namespace
