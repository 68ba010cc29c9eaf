// SPDX-License-Identifier: Apache-2.0
// See camera_depth.h.
#include "src/world/solids/camera_depth.h"

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

Status take_camera_depth(const Camera& camera, const ViewFiles& files, const std::string& name,
                         const Image& image, CameraDepth& depth) {
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
        double metres = double(z->pixels.at(i)) * files.depth_scale;
        if (files.depth_on_axis) metres *= ray_slant(view, double(i % width), double(i / width));
        depth.put(i, metres);
    }
    return Status::ok();
}

Status outline_camera_depth(const Scene& scene, const Context& context, CameraDepth& depth) {
    depth = CameraDepth();
    depth.present = !scene.view_files.depth.empty();
    return depth.present ? refuse_device(scene, context) : Status::ok();
}

}  // namespace pileus
