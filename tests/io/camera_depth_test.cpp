// SPDX-License-Identifier: Apache-2.0
// Depth images: which channel counts, and what is refused.
// in: pictures in memory and on disk -> out: distances, or one line.
// docs/solids.md, "A depth image"
#include "src/world/solids/camera_depth.h"

#include <doctest/doctest.h>

#include "src/io/images/image_file.h"
#include "tests/io/temp_folder.h"

using namespace pileus;

TEST_CASE("camera depth: Z, or the only channel; never a guess among several") {
    Camera camera;
    camera.position_m = {0, 0, 0};
    camera.target_m = {0, 1, 0};
    camera.resolution = {1, 1};
    const auto depth_of = [&](const std::vector<const char*>& names, CameraDepth& depth) {
        Image image;
        image.width = image.height = 1;
        for (std::size_t i = 0; i < names.size(); ++i) {
            image.channels.emplace_back();
            image.channels.back().name = names[i];
            REQUIRE(image.channels.back().pixels.resize(1, "depth"));
            image.channels.back().pixels[0] = float(i + 1);
        }
        return take_camera_depth(camera, {}, "d.exr", image, depth);
    };
    CameraDepth depth;
    for (const char* name : {"Z", "Y", "R", "depth.V"}) {
        REQUIRE(depth_of({name}, depth));
        CHECK(depth.metres[0] == 1.0f);
    }
    REQUIRE(depth_of({"A", "B", "Z"}, depth));
    CHECK(depth.metres[0] == 3.0f);
    const std::string allowed = ", allowed: Z, or a single channel of any name";
    CHECK(depth_of({"A", "B", "G", "R"}, depth).message ==
          "d.exr: depth: no channel Z among A, B, G, R" + allowed);
    CHECK(depth_of({"A", "Y"}, depth).code == Code::kBadInput);
    CHECK(depth_of({"z", "\x1b[31m"}, depth).message ==
          "d.exr: depth: no channel Z among z, \\x1b[31m" + allowed);
    CHECK(depth_of({}, depth).message == "d.exr: depth: no channel Z among none" + allowed);
}

TEST_CASE("camera depth: a .pfm is grey") {
    const test::TempFolder folder;
    const std::string path = folder.path("depth.pfm");
    Image depth;
    depth.width = depth.height = 1;
    for (const char* name : {"R", "G", "B"}) {
        depth.channels.emplace_back();
        depth.channels.back().name = name;
        REQUIRE(depth.channels.back().pixels.resize(1, "depth"));
        depth.channels.back().pixels[0] = 5;
    }
    Scene scene;
    scene.camera.resolution = {1, 1};
    scene.view_files.depth = path;
    CameraDepth read;
    Report report;
    Context context;
    context.report = &report;
    REQUIRE(write_image(depth, path, ToneSettings()));
    REQUIRE(read_camera_depth(scene, context, read));
    CHECK(read.metres[0] == 5.0f);
    depth.channels[2].pixels[0] = 6;
    REQUIRE(write_image(depth, path, ToneSettings()));
    CHECK(read_camera_depth(scene, context, read).message ==
          "camera.depth: " + path + ": depth: colours, R G B differ, allowed: one value a pixel");
}
