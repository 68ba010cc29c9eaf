// SPDX-License-Identifier: Apache-2.0
// How solids are lit, shade and hide in pictures of collectors and raymarch: closed forms.
// in: squares under sun, sky, ground and an even layer of medium -> out: pass or fail.
// docs/solids.md, "How they are lit".
#include <cmath>

#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "src/world/solids/camera_depth.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

constexpr double kHalfTurn = 3.14159265358979323846;
constexpr double kRounding = 4e-6;  // some tens of float operations

/// A square of 2 m over the middle, 10 m up, and a wall behind it.
struct Files {
    test::TempFolder folder;
    std::string square, wall;

    Files() {
        square = folder.path("square.obj");
        wall = folder.path("wall.obj");
        write(square, "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
        write(wall, "v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nf 1 2 3 4\n");
    }
    static void write(const std::string& path, const std::string& text) {
        REQUIRE(write_file(path, {text.data(), text.size()}));
    }
};

/// Looks straight down from 50 m on 8 x 8 m.
std::string looking_down(const std::string& rest) {
    return R"(
[camera]
position_m = [0, 0, 50]
target_m = [0, 0, 0]
up = [0, 1, 0]
projection = "orthographic"
height_m = 8
resolution = [16, 16]
[method]
name = "collectors"
[collectors]
photons = 1000
generations = 4
)" + rest;
}

/// Looks north on 2 x 2 m of the wall.
std::string facing_wall(const std::string& rest) {
    return R"(
[camera]
position_m = [0, -50, 5]
target_m = [0, 0, 5]
projection = "orthographic"
height_m = 2
resolution = [4, 4]
)" + rest;
}

std::string solid(const std::string& file, const char* more) {
    return "[[solid]]\nfile = \"" + file + "\"\n" + more + "\n";
}

}  // namespace

TEST_CASE("solid light: sun and sky on a level square, and its shadow on the ground") {
    const Files files;
    const std::string scene = looking_down(
        "[sun]\nazimuth_deg = 90\nelevation_deg = 30\nirradiance = [3, 2, 1]\n"
        "[sky]\nradiance = [0.5, 0.25, 0.125]\n[ground]\nalbedo = 0.5\n" +
        solid(files.square, "position_m = [0, 0, 1]\nalbedo = [0.25, 0.5, 0.75]"));
    // The square fills pixels 6 to 9 both ways; its shadow lies sqrt(3) m to the west.
    const double albedo[3] = {0.25, 0.5, 0.75}, sun[3] = {3, 2, 1}, sky[3] = {0.5, 0.25, 0.125};
    const char* channels[3] = {"R", "G", "B"};
    for (const char* method : {"method.name=collectors", "method.name=raymarch"}) {
        const Picture p = render_one(scene_from(scene, {method}));
        for (int c = 0; c < 3; ++c) {
            const double lit = sky[c] + sun[c] * 0.5 / kHalfTurn;
            CHECK(p.at(channels[c], 8, 8) == doctest::Approx(albedo[c] * lit).epsilon(kRounding));
            CHECK(p.at(channels[c], 12, 8) == doctest::Approx(0.5 * lit).epsilon(kRounding));
            CHECK(p.at(channels[c], 4, 8) == doctest::Approx(0.5 * sky[c]).epsilon(kRounding));
            CHECK(p.at(channels[c], 1, 8) == doctest::Approx(0.5 * lit).epsilon(kRounding));
        }
    }
}

TEST_CASE("solid light: a wall between sky and ground gets half of each") {
    const Files files;
    const Picture p =
        render_one(scene_from(facing_wall("[sun]\nazimuth_deg = 0\nelevation_deg = 60\n"
                                          "[sky]\nradiance = 0.25\n[ground]\nalbedo = 0.5\n" +
                                          solid(files.wall, "albedo = 0.5")),
                              {"collectors.photons=100"}));
    // The sun stands behind the wall.
    const double ground = 0.5 * (0.25 + 0.86602540378443865 / kHalfTurn);
    CHECK(p.at("R", 2, 2) == doctest::Approx(0.5 * 0.5 * (0.25 + ground)).epsilon(kRounding));
}

TEST_CASE("solid light: wide texels of a sky map light a wall from all of their width") {
    const Files files;
    const std::string map = files.folder.path("sky.pfm");
    // Its halves shine 0.375 and 0.125, turned so that the wall sees as much of both.
    for (const auto& size : {std::pair<int, int>{1, 1}, {2, 1}, {4, 2}, {2, 5}, {200, 90}}) {
        std::vector<float> texels(std::size_t(size.first * size.second), 0.25f);
        for (std::size_t i = 0; size.first > 1 && i < texels.size(); ++i)
            texels[i] = i % std::size_t(size.first) < std::size_t(size.first / 2) ? 0.375f : 0.125f;
        std::string file =
            "Pf\n" + std::to_string(size.first) + " " + std::to_string(size.second) + "\n-1.0\n";
        file.append(reinterpret_cast<const char*>(texels.data()), 4 * texels.size());
        Files::write(map, file);
        for (const char* method : {"method.name=collectors", "method.name=raymarch"}) {
            const Picture p =
                render_one(scene_from(facing_wall("[ground]\nalbedo = 0\n[sky]\nmap = \"" + map +
                                                  "\"\n" + solid(files.wall, "albedo = 0.5")),
                                      {method, "collectors.photons=100"}));
            CAPTURE(size.first);
            // Parts of four degrees: a cosine's second order of half of that.
            CHECK(p.at("R", 2, 2) == doctest::Approx(0.5 * 0.5 * 0.25).epsilon(4e-4));
        }
    }
}

TEST_CASE("solid light: a layer of medium shades what lies below it") {
    const Files files;
    const std::string medium =
        "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[-60, -60, 10], [60, 60, 20]]\n"
        "resolution = [8, 8, 8]\nextinction_per_m = 0.0625\nalbedo = 0\n";
    const Picture p =
        render_one(scene_from(looking_down("[sun]\nazimuth_deg = 90\nelevation_deg = 30\n" +
                                           solid(files.square, "albedo = 1") + medium),
                              {"output.layers=[\"radiance\",\"alpha\",\"depth\"]"}));
    // Once slanted towards the sun, once straight towards the camera.
    const double sunlight = 0.5 / kHalfTurn * std::exp(-0.0625 * 10 * 2),
                 seen = std::exp(-0.0625 * 10);
    CHECK(p.at("R", 8, 8) == doctest::Approx(sunlight * seen).epsilon(2e-5));
    CHECK(p.at("A", 8, 8) == doctest::Approx(1 - seen).epsilon(2e-5));
    CHECK(p.at("Z", 8, 8) == doctest::Approx(50).epsilon(kRounding));
    CHECK(p.at("A", 1, 1) == doctest::Approx(1 - seen).epsilon(2e-5));
    CHECK(p.at("R", 1, 1) == 0.0f);
}

TEST_CASE("solid light: what stands in the medium cuts it, in billboards too") {
    const Files files;
    const std::string medium =
        "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[-20, -20, -5], [20, 20, 5]]\n"
        "resolution = [8, 8, 8]\nextinction_per_m = 0.125\nalbedo = 0\n";
    const std::string scene = looking_down(solid(files.square, "albedo = 1") + medium);
    const Picture p = render_one(scene_from(scene, {}));
    CHECK(p.at("A", 8, 8) == doctest::Approx(1 - std::exp(-0.125 * 5)).epsilon(2e-5));
    CHECK(p.at("A", 1, 1) == doctest::Approx(1 - std::exp(-0.125 * 10)).epsilon(2e-5));
    const Picture b = render_one(scene_from(scene, {"collectors.display=billboards"}));
    CHECK(b.at("A", 8, 8) < 0.8 * b.at("A", 8, 3));
}

TEST_CASE("camera depth: cuts the media, leaves black behind, and is measured both ways") {
    Camera camera;
    camera.position_m = {0, 0, 0};
    camera.target_m = {0, 1, 0};
    camera.fov_deg = 90;
    camera.resolution = {2, 2};
    ViewFiles files;
    files.depth_scale = 2;
    Image image;
    image.width = image.height = 2;
    image.channels.resize(1);
    image.channels[0].name = "Y";
    REQUIRE(image.channels[0].pixels.resize(4, "Y"));
    const float values[4] = {3, 0, -1, __builtin_nanf("")};
    for (std::size_t i = 0; i < 4; ++i) image.channels[0].pixels[i] = values[i];
    CameraDepth depth;
    REQUIRE(take_camera_depth(camera, files, "d.exr", image, depth));
    CHECK(depth.metres[0] == 6.0f);
    CHECK(depth.metres[1] == 0.0f);
    CHECK(depth.metres[2] == 0.0f);
    CHECK(depth.metres[3] == __builtin_inff());
    CHECK(depth.negative == 1);
    CHECK(depth.broken == 1);
    files.depth_on_axis = true;
    REQUIRE(take_camera_depth(camera, files, "d.exr", image, depth));
    // The middle of a pixel lies half of the way to the picture's edge, both ways.
    CHECK(depth.metres[0] == doctest::Approx(6 * std::sqrt(1.5)).epsilon(1e-6));
    camera.resolution = {4, 2};
    const Status wrong = take_camera_depth(camera, files, "d.exr", image, depth);
    CHECK(wrong.message == "d.exr: depth: wrong size, 2 x 2, allowed: 4 x 2, camera.resolution");
}

TEST_CASE("camera depth: a picture with surfaces in front of, within and behind a medium") {
    const test::TempFolder folder;
    const std::string path = folder.path("depth.pfm");
    Image depth;
    depth.width = depth.height = 16;
    depth.channels.resize(3);
    for (std::size_t c = 0; c < 3; ++c) {
        depth.channels[c].name = c == 0 ? "R" : c == 1 ? "G" : "B";
        REQUIRE(depth.channels[c].pixels.resize(256, "depth"));
        for (std::size_t i = 0; i < 256; ++i) {
            const float rows[4] = {0, 45, 50, __builtin_inff()};
            depth.channels[c].pixels[i] = rows[i / 64];
        }
    }
    REQUIRE(write_image(depth, path, ToneSettings()));
    const std::string scene = looking_down(
        "[sky]\nradiance = 0.5\n[[medium]]\ndensity = \"uniform:box\"\n"
        "bounds_m = [[-20, -20, -5], [20, 20, 5]]\nresolution = [8, 8, 8]\n"
        "extinction_per_m = 0.125\nalbedo = 0\n");
    // Method path has a test of its own: tests/energy/path_solids_test.cpp.
    for (const char* method : {"method.name=collectors", "method.name=raymarch"}) {
        const Picture p = render_one(scene_from(scene, {method, "camera.depth=\"" + path + "\""}));
        CHECK(p.at("A", 8, 1) == 0.0f);
        CHECK(p.at("R", 8, 1) == 0.0f);
        CHECK(p.at("A", 8, 5) == doctest::Approx(0).epsilon(1e-6));
        CHECK(p.at("A", 8, 9) == doctest::Approx(1 - std::exp(-0.125 * 5)).epsilon(2e-5));
        CHECK(p.at("R", 8, 9) == 0.0f);
        CHECK(p.at("A", 8, 14) == doctest::Approx(1 - std::exp(-0.125 * 10)).epsilon(2e-5));
        CHECK(p.at("R", 8, 14) == doctest::Approx(0.5 * std::exp(-0.125 * 10)).epsilon(2e-5));
    }
}
