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
    for (const char* name : {"Z", "Y", "R", "depth.V", "A"}) {
        REQUIRE(depth_of({name}, depth));
        CHECK(depth.metres[0] == 1.0f);
    }
    REQUIRE(depth_of({"A", "B", "Z"}, depth));
    CHECK(depth.metres[0] == 3.0f);
    // Under the names of other programs; normals and places have a z of their own.
    const std::vector<std::vector<const char*>> layers = {
        {"A", "B", "depth.Z"},
        {"A", "R", "ViewLayer.Depth.Z"},
        {"A", "B", "Depth.V"},
        {"A", "G", "zDepth"},
        {"R", "Normal.X", "ViewLayer.Depth.Z", "Normal.Y", "Normal.Z"},
        {"beauty.R", "P.x", "depth.R", "P.y", "P.z"}};
    for (const auto& names : layers) {
        const Status status = depth_of(names, depth);
        REQUIRE_MESSAGE(status, status.message);
        CHECK(depth.metres[0] == 3.0f);
    }
    const std::string allowed =
        ", allowed: Z, one layer of depth, a single channel of any name, or three that are equal";
    CHECK(depth_of({"A", "B", "G", "R"}, depth).message ==
          "d.exr: depth: colours, R G B differ, allowed: one value a pixel");
    CHECK(depth_of({"B", "G", "R", "id"}, depth).code == Code::kBadInput);
    CHECK(depth_of({"left.Depth.Z", "right.Depth.Z"}, depth).message ==
          "d.exr: depth: several among left.Depth.Z, right.Depth.Z" + allowed);
    CHECK(depth_of({"N.X", "N.Y", "N.Z"}, depth).code == Code::kBadInput);
    CHECK(depth_of({"u", "\x1b[31m"}, depth).message ==
          "d.exr: depth: no channel Z among u, \\x1b[31m" + allowed);
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

TEST_CASE("camera depth: three equal channels are one, with alpha or without") {
    Camera camera;
    camera.position_m = {0, 0, 0};
    camera.target_m = {0, 1, 0};
    camera.resolution = {2, 1};
    for (const bool alpha : {false, true})
        for (const char* layer : {"", "depth.", "x.y."}) {
            Image image;
            image.width = 2, image.height = 1;
            for (const char* name : {"B", "G", "R", "A"}) {
                if (*name == 'A' && !alpha) continue;
                image.channels.emplace_back();
                image.channels.back().name = std::string(layer) + name;
                REQUIRE(image.channels.back().pixels.resize(2, "depth"));
                image.channels.back().pixels[0] = *name == 'A' ? 1.0f : 7.0f;
                image.channels.back().pixels[1] = *name == 'A' ? 1.0f : 9.0f;
            }
            CameraDepth depth;
            const Status status = take_camera_depth(camera, {}, "d.exr", image, depth);
            REQUIRE_MESSAGE(status, status.message);
            CHECK(depth.metres[0] == 7.0f);
            CHECK(depth.metres[1] == 9.0f);
            image.channels[1].pixels[1] = 8;
            CHECK(take_camera_depth(camera, {}, "d.exr", image, depth).code == Code::kBadInput);
        }
}
