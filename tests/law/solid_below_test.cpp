// SPDX-License-Identifier: Apache-2.0
// Light of media on solids: below a deck they have what the ground below has, above it all of the
// sky. in: a plate and a wall under and over a deck -> out: radiances against paths.
// docs/solids.md, "How they are lit"
#include "tests/law/solid_pictures.h"

using namespace solid_test;

namespace {

constexpr const char* kPlate =
    "v -300 -300 0\nv 300 -300 0\nv 300 300 0\nv -300 300 0\nf 1 2 3\nf 1 3 4\n";
constexpr const char* kWall =
    "v -300 0 -150\nv 300 0 -150\nv 300 0 150\nv -300 0 150\nf 1 2 3\nf 1 3 4\n";

constexpr const char* kDeck = R"(
[camera]
position_m = [0, -900, 450]
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
albedo = 0.4
[path]
pixel = "centre"
samples_per_pixel = 600
[[medium]]
density = "uniform:box"
bounds_m = [[-4000, -4000, 700], [4000, 4000, 1100]]
resolution = [16, 16, 8]
extinction_per_m = 0.02
phase = { type = "henyey-greenstein", g = 0.85 }
)";

const Meshes kMeshes = {{"plate.obj", kPlate}, {"wall.obj", kWall}};
constexpr Pixels kSolid{3, 2, 9, 6};

void compare(const std::string& solid, double tolerance, const std::vector<std::string>& more) {
    compare_with_path(kDeck + solid, kMeshes, kSolid, tolerance, more);
}

std::string placed(const char* file, double height) {
    return std::string("[[solid]]\nalbedo = 0.6\nfile = \"") + file + "\"\nposition_m = [0, 0, " +
           std::to_string(height) + "]\n";
}

}  // namespace

TEST_CASE("solids below a deck have the light that comes through it") {
    // Without it a plate was twice as bright. Walls see the ground beside, in the deck's shadow.
    compare(placed("plate.obj", 200), 0.05, {});
    compare(placed("wall.obj", 200), 0.08, {});
}

TEST_CASE("solids at the foot of fog have the light of the ground beside them") {
    // Of it nodes within the fog make 8 %.
    compare(placed("plate.obj", 1), 0.1,
            {"medium.0.bounds_m=[[-4000,-4000,0],[4000,4000,400]]",
             "medium.0.extinction_per_m=0.004", "camera.target_m=[0,0,1]"});
}

TEST_CASE("solids below a deck over a black ground, or without one, are as they were") {
    const std::string plate = placed("plate.obj", 200);
    for (const char* ground : {"ground.albedo=0", "sun.irradiance=0"}) {
        const auto found = means_of(kDeck + plate, kMeshes, "raymarch", kSolid, {ground});
        for (const double light : found) CHECK(std::isfinite(light));
    }
}

TEST_CASE("solids above a deck have all of the sky") {
    compare(placed("plate.obj", 1500), 0.1,
            {"camera.position_m=[0,-900,1750]", "camera.target_m=[0,0,1500]"});
}
