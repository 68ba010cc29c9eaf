// SPDX-License-Identifier: Apache-2.0
// See camera_depth.h.
#include "src/world/solids/camera_depth.h"

#include <cstring>

#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "src/scene/read_scene.h"
#include "src/world/camera/view.h"
#include "src/world/solids/solids.h"

namespace pileus {
namespace {

/// The plane of distances: Z, or the only one there is. Any other choice would be a guess.
Status find_depth(const std::string& name, const Image& image, const Channel*& z) {
    z = image.find("Z");
    if (z == nullptr && image.channels.size() == 1) z = &image.channels[0];
    if (z != nullptr) return Status::ok();
    std::string list;
    for (const Channel& channel : image.channels) list += (list.empty() ? "" : ", ") + channel.name;
    return Status::bad_input(name + ": depth: no channel Z among " +
                             (list.empty() ? "none" : printable_line(list)) +
                             ", allowed: Z, or a single channel of any name");
}

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

void CameraDepth::put(std::size_t pixel, double value) {
    float along = value >= 1e30 ? __builtin_inff() : float(value);
    if (!(value == value)) {
        along = __builtin_inff();
        ++broken;
    } else if (value < 0) {
        along = 0;
        ++negative;
    }
    metres[pixel] = along;
}

Status take_camera_depth(const Camera& camera, const std::string& name, const Image& image,
                         CameraDepth& depth) {
    if (image.width != camera.resolution[0] || image.height != camera.resolution[1])
        return Status::bad_input(name + ": depth: wrong size, " + std::to_string(image.width) +
                                 " x " + std::to_string(image.height) +
                                 ", allowed: " + std::to_string(camera.resolution[0]) + " x " +
                                 std::to_string(camera.resolution[1]) + ", camera.resolution");
    const Channel* z = nullptr;
    PILEUS_TRY(find_depth(name, image, z));
    const CameraParams view = make_camera(camera, 0, {});
    const std::size_t width = std::size_t(image.width);
    const std::size_t pixels = width * std::size_t(image.height);
    PILEUS_TRY(depth.metres.resize(pixels, "camera depth"));
    depth.columns = width;
    for (std::size_t i = 0; i < pixels; ++i) {
        double metres = double(z->pixels.at(i)) * camera.depth_scale;
        if (camera.depth_on_axis) metres *= ray_slant(view, double(i % width), double(i / width));
        depth.put(i, metres);
    }
    return Status::ok();
}

Status outline_camera_depth(const Scene& scene, const Context& context, CameraDepth& depth) {
    depth = CameraDepth();
    depth.present = !scene.camera.depth.empty();
    return depth.present ? refuse_device(scene, context) : Status::ok();
}

Status read_camera_depth(const Scene& scene, const Context& context, CameraDepth& depth) {
    if (scene.camera.depth.empty()) return Status::ok();
    const StageClock clock(context, "solids");
    const std::string path = depth_path(scene);
    Image image;
    PILEUS_TRY(at_key(scene, "camera.depth", read_image(path, image)));
    if (file_extension(path) == ".pfm")
        PILEUS_TRY(at_key(scene, "camera.depth", keep_one_plane(path, image)));
    return at_key(scene, "camera.depth", take_camera_depth(scene.camera, path, image, depth));
}

}  // namespace pileus
