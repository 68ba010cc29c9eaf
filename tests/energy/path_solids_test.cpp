// SPDX-License-Identifier: Apache-2.0
// Paths among solids: the furnace, closed forms of a plane, shadows both ways, a depth image.
// in: meshes in small files, media, one light each -> out: pass or fail.
// docs/solids.md; docs/testing.md. Differences are judged in standard errors of the film.
#include <cmath>
#include <cstdio>

#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

constexpr double kHalfTurn = 3.14159265358979323846;
/// Of a normal distribution: beyond it lies one of 15,000 draws; some hundred are looked at.
constexpr double kFar = 4;

struct Files {
    test::TempFolder folder;
    std::string square, cube;

    Files() {
        square = folder.path("square.obj");
        cube = folder.path("cube.obj");
        write(square, "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
        write(cube,
              "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
              "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    }
    static void write(const std::string& path, const std::string& text) {
        REQUIRE(write_file(path, {text.data(), text.size()}));
    }
};

std::string camera(const char* position, const char* rest) {
    return std::string("[camera]\nposition_m = ") + position +
           "\ntarget_m = [0, 0, 0]\nup = [0, 1, 0]\nprojection = \"orthographic\"\n" + rest +
           "[method]\nname = \"path\"\n[output]\nlayers = [\"radiance\", \"alpha\", \"error\"]\n";
}

std::string solid(const std::string& file, const char* more) {
    return "[[solid]]\nfile = \"" + file + "\"\n" + more + "\n";
}

std::string box(double half, double extinction, double albedo) {
    const std::string h = std::to_string(half);
    return "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[-" + h + ",-" + h + ",-" + h +
           "],[" + h + "," + h + "," + h +
           "]]\nresolution = [8, 8, 8]\nextinction_per_m = " + std::to_string(extinction) +
           "\nalbedo = " + std::to_string(albedo) + "\n";
}

/// Mean of all pixels, and one standard error of it.
struct Mean {
    double value = 0, error = 0;
};
Mean mean_of(const Picture& p) {
    Mean m;
    const int n = p.image.width * p.image.height;
    for (int y = 0; y < p.image.height; ++y)
        for (int x = 0; x < p.image.width; ++x) {
            const double e = double(p.at("error.G", x, y));
            m.value += double(p.at("G", x, y)) / n;
            m.error += e * e / n / n;
        }
    m.error = std::sqrt(m.error);
    return m;
}

}  // namespace

TEST_CASE("path, solids: white ones in a white cloud in an even sky cannot be seen") {
    const Files files;
    const Picture p = render_one(
        scene_from(camera("[30, 20, 25]", "height_m = 12\nresolution = [12, 12]\n") +
                       "[sky]\nradiance = 0.5\n" +
                       solid(files.cube, "albedo = 1\nrotation_deg = [20, 30, 40]") +
                       solid(files.square, "albedo = 1\nposition_m = [0, 0, 2.5]\nscale = 3") +
                       box(4, 0.25, 1),
                   {"path.samples_per_pixel=24"}));
    // Every path that ends brings the sky's radiance, whatever it has met: no noise at all.
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) CHECK(p.at("G", x, y) == doctest::Approx(0.5).epsilon(1e-5));
    CHECK(p.counter("terminated") == 0);
}

TEST_CASE("path, solids: a square under sun and sky, through a cloud that absorbs") {
    const Files files;
    const char* view = "height_m = 1\nresolution = [6, 6]\n";
    const std::string sun = "[sun]\nazimuth_deg = 90\nelevation_deg = 30\n";
    const std::string square = solid(files.square, "albedo = 0.5");
    const Picture bare = render_one(
        scene_from(camera("[0, 0, 50]", view) + sun + square, {"path.samples_per_pixel=4"}));
    const double lit = 0.5 * 0.5 / kHalfTurn;
    for (int i = 0; i < 6; ++i) CHECK(bare.at("G", i, i) == doctest::Approx(lit).epsilon(1e-5));

    // The layer reaches 2 m up: 4 m of it towards the sun, 2 m towards the camera.
    const Picture veiled = render_one(
        scene_from(camera("[0, 0, 50]", view) + sun + square + box(2, 0.125, 0),
                   {"path.samples_per_pixel=512", "medium.0.bounds_m=[[-9,-9,-2],[9,9,2]]"}));
    const Mean got = mean_of(veiled);
    CHECK(got.error < 0.02 * got.value);
    CHECK(std::abs(got.value - lit * std::exp(-0.125 * 6)) < kFar * got.error);

    const Picture sky =
        render_one(scene_from(camera("[0, 0, 50]", view) + "[sky]\nradiance = 0.5\n" + square,
                              {"path.samples_per_pixel=4"}));
    for (int i = 0; i < 6; ++i) CHECK(sky.at("G", i, i) == doctest::Approx(0.25).epsilon(1e-5));
}

TEST_CASE("path, solids: colours of solids in a grey medium, and the ground behind") {
    const Files files;
    const Picture p = render_one(
        scene_from(camera("[0, 0, 50]", "height_m = 8\nresolution = [8, 8]\n") +
                       "[sky]\nradiance = 0.5\n[ground]\naltitude_m = -9\nalbedo = 0.5\n" +
                       solid(files.square, "albedo = [0.25, 0.5, 1]") + box(4, 0.0625, 1),
                   {"path.samples_per_pixel=64", "medium.0.extinction_per_m=1e-9"}));
    // A level square and a ground that it hardly shades: both under half a sphere of sky.
    const float sum = p.at("R", 4, 4) + p.at("R", 3, 3);
    CHECK(p.at("R", 4, 4) / p.at("B", 4, 4) == doctest::Approx(0.25).epsilon(0.02));
    CHECK(p.at("G", 4, 4) == doctest::Approx(0.25).epsilon(0.02));
    CHECK(sum > 0);
    CHECK(p.at("G", 0, 0) == doctest::Approx(0.25).epsilon(0.1));
}

TEST_CASE("path, solids: a plate between sun and cloud leaves it dark, one behind does not") {
    const Files files;
    const std::string scene = camera("[0, 0, 50]", "height_m = 4\nresolution = [6, 6]\n") +
                              "[sun]\nazimuth_deg = 0\nelevation_deg = 0\n" + box(2, 0.25, 0.9);
    const auto lit = [&](const char* place) {
        return mean_of(render_one(
            scene_from(scene + solid(files.square, place), {"path.samples_per_pixel=64"})));
    };
    // The sun is in the north (+y).
    const Mean free = lit("position_m = [0, 0, -30]\nalbedo = 0");
    const Mean dark =
        lit("position_m = [0, 9, 0]\nrotation_deg = [90, 0, 0]\nscale = 5\nalbedo = 0");
    const Mean behind =
        lit("position_m = [0, -9, 0]\nrotation_deg = [90, 0, 0]\nscale = 5\nalbedo = 0");
    CHECK(dark.value == 0);
    CHECK(free.value > 0.01);
    CHECK(std::abs(free.value - behind.value) <
          kFar * std::sqrt(free.error * free.error + behind.error * behind.error));
    // A white plate right behind sends light back into the cloud.
    const Mean bright =
        lit("position_m = [0, -2.5, 0]\nrotation_deg = [90, 0, 0]\nscale = 9\nalbedo = 1");
    CHECK(bright.value > free.value + kFar * (free.error + bright.error));
}

TEST_CASE(
    "path, solids: guided to the sun's disc or not, the same light; the same bits at any width") {
    const Files files;
    const std::string scene =
        camera("[0, 0, 50]", "height_m = 4\nresolution = [6, 6]\n") +
        "[sun]\nazimuth_deg = 20\nelevation_deg = 35\nangular_radius_deg = 3\n" +
        solid(files.square, "albedo = 1\nrotation_deg = [20, 30, 0]") + box(2, 0.5, 0.95) +
        "phase = { type = \"henyey-greenstein\", g = 0.95 }\n";
    const auto traced = [&](const char* guide, const char* samples, const KernelTable* kernels) {
        RenderOptions options;
        options.kernels = kernels;
        return render_one(scene_from(scene, {guide, samples}), options);
    };
    const Mean with = mean_of(traced("path.guide=true", "path.samples_per_pixel=2048", nullptr));
    const Mean without =
        mean_of(traced("path.guide=false", "path.samples_per_pixel=8192", nullptr));
    std::printf("solids, g 0.95: guided %.5g se %.1g, unguided %.5g se %.1g\n", with.value,
                with.error, without.value, without.error);
    CHECK(std::abs(with.value - without.value) <
          kFar * std::sqrt(with.error * with.error + without.error * without.error));
    std::string hash;
    for (int i = 0; const KernelTable* kernels = kernel_table_at(i); ++i) {
        const Picture p = traced("path.guide=true", "path.samples_per_pixel=16", kernels);
        if (i == 0) hash = p.report.hash;
        CHECK(p.report.hash == hash);
    }
}

TEST_CASE("path, solids: a closed white room is given up, and says so") {
    const Files files;
    const Picture p = render_one(scene_from(R"(
[camera]
position_m = [0, 0.5, 0]
target_m = [0, 0, 0]
resolution = [2, 1]
[method]
name = "path"
[path]
samples_per_pixel = 1
[sky]
radiance = 1
)" + solid(files.cube, "albedo = 1"),
                                            {}));
    CHECK(p.counter("terminated") == 2);
    CHECK(p.at("G", 0, 0) == 0.0f);
}

TEST_CASE("path, solids: the camera's image ends its rays, and theirs alone") {
    const Files files;
    const std::string path = files.folder.path("depth.pfm");
    Image depth;
    depth.width = depth.height = 4;
    depth.channels.resize(3);
    for (std::size_t c = 0; c < 3; ++c) {
        depth.channels[c].name = c == 0 ? "R" : c == 1 ? "G" : "B";
        REQUIRE(depth.channels[c].pixels.resize(16, "depth"));
        const float rows[4] = {0, 48, 50, __builtin_inff()};
        for (std::size_t i = 0; i < 16; ++i) depth.channels[c].pixels[i] = rows[i / 4];
    }
    REQUIRE(write_image(depth, path, ToneSettings()));
    // An even sky around white medium: what a ray meets before its end shines like the sky.
    const Picture p =
        render_one(scene_from(camera("[0, 0, 50]", "height_m = 1\nresolution = [4, 4]\n") +
                                  "[sky]\nradiance = 0.5\n" + box(2, 0.25, 1),
                              {"path.samples_per_pixel=256", "camera.depth=\"" + path + "\"",
                               "medium.0.bounds_m=[[-90,-90,-2],[90,90,2]]"}));
    for (int x = 0; x < 4; ++x) {
        CHECK(p.at("G", x, 0) == 0.0f);
        CHECK(p.at("A", x, 0) == 0.0f);
        CHECK(p.at("G", x, 1) == 0.0f);  // just before the medium
        const double seen = 1 - std::exp(-0.25 * 2);
        CHECK(p.at("A", x, 2) == doctest::Approx(seen).epsilon(2e-5));
        CHECK(std::abs(double(p.at("G", x, 2)) - 0.5 * seen) <
              kFar * double(p.at("error.G", x, 2)));
        CHECK(p.at("G", x, 3) == doctest::Approx(0.5).epsilon(1e-5));
    }
}
