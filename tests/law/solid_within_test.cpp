// SPDX-License-Identifier: Apache-2.0
// Solids within media, by discrete ordinates: light ends at them, is sent back, and falls on them
// as the media let it. in: boxes and plates in fog -> out: radiances against paths, a white
// furnace. docs/ordinates.md, "Solids"
#include "tests/law/solid_pictures.h"

using namespace pileus;
using namespace render_test;
using namespace solid_test;

namespace {

constexpr const char* kPlate =
    "v -400 -400 0\nv 400 -400 0\nv 400 400 0\nv -400 400 0\nf 1 2 3 4\n";
constexpr const char* kBox =
    "v -300 -300 0\nv 300 -300 0\nv 300 300 0\nv -300 300 0\nv -300 -300 400\nv 300 -300 400\n"
    "v 300 300 400\nv -300 300 400\nf 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
    "f 4 1 5 8\n";

constexpr const char* kFog = R"(
[camera]
position_m = [0, -2500, 900]
target_m = [0, 0, 200]
fov_deg = 12
resolution = [12, 8]
[sun]
azimuth_deg = 150
elevation_deg = 50
[sky]
radiance = [0.1, 0.2, 0.3]
[ground]
altitude_m = 0
albedo = 0.3
[path]
pixel = "centre"
samples_per_pixel = 500
[[medium]]
density = "uniform:box"
bounds_m = [[-1000, -1000, 0], [1000, 1000, 800]]
resolution = [32, 32, 16]
extinction_per_m = 0.005
phase = { type = "henyey-greenstein", g = 0.85 }
)";

const Meshes kMeshes = {{"plate.obj", kPlate}, {"box.obj", kBox}};
constexpr Pixels kAll{0, 0, 12, 8};

void compare(const std::string& solid, double tolerance, const std::vector<std::string>& sets) {
    compare_with_path(kFog + solid, kMeshes, kAll, tolerance, sets);
}

std::string placed(const char* file, const char* place, const char* albedo) {
    return std::string("[[solid]]\nfile = \"") + file + "\"\nposition_m = " + place +
           "\nalbedo = " + albedo + "\n";
}

}  // namespace

TEST_CASE("a black box in fog takes the light that would come through it") {
    // Without it the fog before the box was 49 % too bright. Fog alone has 2 %.
    compare(placed("box.obj", "[0, 0, 0]", "0"), 0.07, {});
}

TEST_CASE("a box of any colour sends light back into fog") {
    compare(placed("box.obj", "[0, 0, 0]", "[0.9, 0.5, 0.1]"), 0.07, {});
    compare(placed("box.obj", "[0, 0, 0]", "0.6"), 0.07, {"medium.0.albedo=[1, 0.97, 0.9]"});
}

TEST_CASE("a plate in fog shades what is below it") {
    // Within a node of its edge light goes around it.
    compare(placed("plate.obj", "[0, 0, 400]", "0.2"), 0.12,
            {"camera.position_m=[0,-2500,200]", "camera.target_m=[0,0,300]"});
    compare(placed("plate.obj", "[0, 0, 400]", "0.8"), 0.07,
            {"camera.position_m=[0,-2500,900]", "camera.target_m=[0,0,400]"});
}

TEST_CASE("a solid beside a medium keeps light from it") {
    // A wall that stands outside of the box, across half of its sky.
    compare(placed("box.obj", "[0, -1400, 0]", "0.5"), 0.07,
            {"camera.position_m=[2500,-2500,900]", "solid.0.scale=3"});
}

TEST_CASE("without a ground surfaces have the sun's forward peak") {
    // Three depths of fog lie above the plate: e^-3 of the sunlight is a tenth of what arrives.
    compare(placed("plate.obj", "[0, 0, 200]", "0.6"), 0.12,
            {"camera.position_m=[0,-700,500]", "camera.target_m=[0,0,200]", "sky.radiance=0",
             "ground.altitude_m=-100000", "ground.albedo=0"});
}

TEST_CASE("walls that face one another, and sheets, are no closed solids") {
    // Across a street ways of one direction end at both walls.
    const std::string street =
        "v -40 -400 0\nv -40 400 0\nv -40 400 300\nv -40 -400 300\n"
        "v 40 -400 0\nv 40 400 0\nv 40 400 300\nv 40 -400 300\n"
        "f 1 2 3 4\nf 5 6 7 8\n";
    for (const char* turn : {"0", "11.25", "22.5", "45", "80"}) {
        const test::TempFolder folder;
        folder.put("street.obj", street);
        Scene scene = scene_from(kFog + placed("street.obj", "[0, 0, 100]", "0.5"),
                                 {std::string("solid.0.rotation_deg=[0,0,") + turn + "]",
                                  "camera.position_m=[0,-2500,300]", "method.name=raymarch"});
        scene.directory = folder.path("");
        const Picture p = render_one(scene);
        CAPTURE(turn);
        for (int x = 0; x < p.image.width; ++x) CHECK(p.at("G", x, 4) > 0.05f);
    }
}

TEST_CASE("a white furnace stays white with white solids") {
    const std::vector<std::string> even = {"sun.irradiance=0", "sky.radiance=[1,1,1]",
                                           "ground.albedo=1"};
    for (const char* file : {"box.obj", "plate.obj"}) {
        const auto means =
            means_of(kFog + placed(file, "[0, 0, 200]", "1"), kMeshes, "raymarch", kAll, even);
        CAPTURE(file);
        for (const double light : means) CHECK(std::fabs(light - 1) < 0.005);
    }
}
