// SPDX-License-Identifier: Apache-2.0
// See camera_depth.h: from a file.
#include <cstring>

#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "src/scene/read_scene.h"
#include "src/world/solids/camera_depth.h"

namespace pileus {
namespace {

/// A .pfm has no names: its one plane comes as R G B, and so does a grey picture in colours.
Status keep_one_plane(const std::string& name, Image& image) {
    const Buffer<float>& first = image.channels.front().pixels;
    for (const Channel& other : image.channels)
        if (other.pixels.size() != first.size() ||
            std::memcmp(other.pixels.data(), first.data(), first.bytes()) != 0)
            return Status::bad_input(name +
                                     ": depth: colours, R G B differ, allowed: one value a pixel");
    image.channels.resize(1);
    return Status::ok();
}

}  // namespace

Status read_camera_depth(const Scene& scene, const Context& context, CameraDepth& depth) {
    if (scene.view_files.depth.empty()) return Status::ok();
    const StageClock clock(context, "solids");
    const std::string path = depth_path(scene);
    Image image;
    PILEUS_TRY(at_key(scene, "camera.depth", read_image(path, image)));
    if (file_extension(path) == ".pfm")
        PILEUS_TRY(at_key(scene, "camera.depth", keep_one_plane(path, image)));
    return at_key(scene, "camera.depth",
                  take_camera_depth(scene.camera, scene.view_files, path, image, depth));
}

}  // namespace pileus
