// SPDX-License-Identifier: Apache-2.0
// Light on smooth solids and maps of heights: the furnace, path against raymarch, colours of a map.
// in: meshes and maps in small files, sun and sky -> out: pass or fail.
// docs/solids.md, "Smooth normals", "Maps of albedo".
#include <cmath>
#include <cstring>

#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"
#include "tests/support/solid_harness.h"

using namespace render_test;

namespace {

std::string obj_of(const TestMesh& mesh) {
    std::string text;
    char line[128];
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
        std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", mesh.corners[i], mesh.corners[i + 1],
                      mesh.corners[i + 2]);
        text += line;
    }
    for (std::size_t i = 1; i <= mesh.corners.size() / 3; i += 3)
        text += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " +
                std::to_string(i + 2) + "\n";
    return text;
}

/// A round hill of 33 x 33 samples as float32.
std::string hill() {
    std::string bytes;
    for (int r = 0; r < 33; ++r)
        for (int c = 0; c < 33; ++c) {
            const double x = (c - 16) / 16.0, y = (r - 16) / 16.0;
            const float h = float(6 * std::exp(-4 * (x * x + y * y)));
            char four[4];
            std::memcpy(four, &h, 4);
            bytes.append(four, 4);
        }
    return bytes;
}

const char* const kHill =
    "[[solid]]\nfile = \"hill.raw\"\nraw_size = [33, 33]\nraw_type = \"float32\"\n"
    "bounds_m = [[-10, -10], [10, 10]]\n";

std::string camera(const char* position, const char* rest) {
    return std::string("[camera]\nposition_m = ") + position +
           "\ntarget_m = [0, 0, 0]\nup = [0, 1, 0]\nprojection = \"orthographic\"\n" + rest;
}

Picture render(const std::string& text, const test::TempFolder& folder,
               const std::vector<std::string>& set) {
    Scene scene = scene_from(text, set);
    scene.directory = folder.path("");
    return render_one(scene);
}

double mean_of(const Picture& p, const char* channel) {
    double sum = 0;
    for (int y = 0; y < p.image.height; ++y)
        for (int x = 0; x < p.image.width; ++x) sum += double(p.at(channel, x, y));
    return sum / (p.image.width * p.image.height);
}

}  // namespace

TEST_CASE("smooth solids: white ones in an even sky cannot be seen by path") {
    const test::TempFolder folder;
    folder.put("ball.obj", obj_of(ball_mesh(5, 3)));
    const std::string scene = camera("[20, 14, 11]", "height_m = 7\nresolution = [24, 24]\n") +
                              "[sky]\nradiance = 0.5\n[[solid]]\nfile = \"ball.obj\"\nalbedo = 1\n"
                              "smooth = true\n";
    const Picture p = render(scene, folder, {"method.name=path", "path.samples_per_pixel=64"});
    // What goes below a facet meets it again and goes on: no light is lost.
    double worst = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x)
            worst = std::fmax(worst, std::fabs(double(p.at("G", x, y)) - 0.5));
    MESSAGE("furnace, worst pixel: " << worst / 0.5);
    CHECK(worst < 0.5e-5);
    CHECK(p.counter("terminated") == 0);
    // One that absorbs sends back no more than its albedo; facets of 36 degrees lose 2 %.
    const auto grey = [&](const char* smooth) {
        return mean_of(render(scene, folder,
                              {"method.name=path", "path.samples_per_pixel=256",
                               "solid.0.albedo=0.5", std::string("solid.0.smooth=") + smooth}),
                       "G");
    };
    const double half = grey("true"), flat = grey("false");
    MESSAGE("albedo 1/2: smooth " << half << ", flat " << flat);
    CHECK(half <= flat * 1.003);
    CHECK(half > flat * 0.98);
}

TEST_CASE("smooth solids: path and raymarch see a hill of a map alike, under sun and sky") {
    const test::TempFolder folder;
    folder.put("hill.raw", hill());
    const std::string scene = camera("[0, -30, 30]", "height_m = 16\nresolution = [16, 12]\n") +
                              "[sun]\nazimuth_deg = 250\nelevation_deg = 40\nirradiance = 2\n" +
                              kHill + "albedo = 0.6\n";
    const auto see = [&](const char* method, const char* smooth) {
        return render(scene, folder,
                      {std::string("method.name=") + method, "path.samples_per_pixel=512",
                       std::string("solid.0.smooth=") + smooth});
    };
    for (const char* smooth : {"true", "false"}) {
        const Picture truth = see("path", smooth), found = see("raymarch", smooth);
        const double ratio = mean_of(found, "G") / mean_of(truth, "G");
        MESSAGE("raymarch / path, smooth " << std::string(smooth) << ": " << ratio);
        // Light from one flank on the other is what raymarch leaves out.
        CHECK(std::fabs(ratio - 1) < 0.03);
    }
}

TEST_CASE("solids: a map of albedo lies north up, and is multiplied") {
    const test::TempFolder folder;
    folder.put("plate.obj",
               "v -2 -2 0\nv 0 -2 0\nv 2 -2 0\nv -2 0 0\nv 0 0 0\nv 2 0 0\nv -2 2 0\n"
               "v 0 2 0\nv 2 2 0\nf 1 2 5 4\nf 2 3 6 5\nf 4 5 8 7\nf 5 6 9 8\n");
    // PFM begins with its lowest row: south-west red, south-east green, north white and black.
    std::string map = "PF\n2 2\n-1\n";
    for (const float v : {1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f}) {
        char four[4];
        std::memcpy(four, &v, 4);
        map.append(four, 4);
    }
    folder.put("map.pfm", map);
    const std::string scene = camera("[0, 0, 50]", "height_m = 4\nresolution = [8, 8]\n") +
                              "[sky]\nradiance = 1\n[[solid]]\nfile = \"plate.obj\"\n"
                              "albedo_map = \"map.pfm\"\nalbedo_map_scale = 0.5\n";
    for (const char* method : {"raymarch", "path"}) {
        CAPTURE(method);
        const Picture p = render(
            scene, folder, {std::string("method.name=") + method, "path.samples_per_pixel=64"});
        // A triangle's middle lies a sixth of the plate from its quarter's: 2/3 of the pure colour.
        CHECK(double(p.at("R", 0, 7)) > 0.33);
        CHECK(double(p.at("G", 0, 7)) < 0.2);
        CHECK(double(p.at("G", 7, 7)) > 0.33);
        CHECK(double(p.at("B", 0, 0)) > 0.33);
        CHECK(double(p.at("R", 7, 0)) < 0.2);
        CHECK(double(p.at("R", 0, 0)) <= 0.5 + 1e-6);
    }
    Scene bad = scene_from(scene, {"method.name=raymarch", "solid.0.albedo_map_scale=2"});
    bad.directory = folder.path("");
    const Status status = render(bad, {}, [](int, Image&, Report&) { return Status::ok(); });
    CHECK(!status);
    CHECK(status.message.find("map.pfm: albedo: R at row 0, column 0: out of range, 2, allowed: "
                              "within [0, 1] once multiplied by albedo_map_scale") !=
          std::string::npos);
}
