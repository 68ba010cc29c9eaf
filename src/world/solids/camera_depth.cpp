// SPDX-License-Identifier: Apache-2.0
// See camera_depth.h.
#include "src/world/solids/camera_depth.h"

#include "src/io/images/image_file.h"
#include "src/scene/read_scene.h"
#include "src/world/camera/view.h"

namespace pileus {
namespace {

/// Metres along the ray of a pixel per metre along the view's axis.
double slant(const CameraParams& camera, std::size_t x, std::size_t y) {
    if (camera.orthographic != 0) return 1;
    const double sx = ((double(x) + 0.5) * 2 / camera.width - 1) * double(camera.half_width);
    const double sy = (1 - (double(y) + 0.5) * 2 / camera.height) * double(camera.half_height);
    return __builtin_sqrt(1 + sx * sx + sy * sy);
}

}  // namespace

Status take_camera_depth(const Camera& camera, const std::string& name, const Image& image,
                         Solids& solids) {
    if (image.width != camera.resolution[0] || image.height != camera.resolution[1])
        return Status::bad_input(name + ": depth: wrong size, " + std::to_string(image.width) +
                                 " x " + std::to_string(image.height) +
                                 ", allowed: " + std::to_string(camera.resolution[0]) + " x " +
                                 std::to_string(camera.resolution[1]) + ", camera.resolution");
    if (image.channels.empty())
        return Status::bad_input(name + ": depth: no channel, allowed: Z, or any");
    const Channel* z = image.find("Z");
    if (z == nullptr) z = &image.channels[0];
    const CameraParams view = make_camera(camera, 0, {});
    const std::size_t width = std::size_t(image.width);
    PILEUS_TRY(solids.camera_depth.resize(z->pixels.size(), "camera depth"));
    solids.depth_columns = width;
    for (std::size_t i = 0; i < z->pixels.size(); ++i) {
        double metres = double(z->pixels[i]) * camera.depth_scale;
        if (camera.depth_on_axis) metres *= slant(view, i % width, i / width);
        if (!(metres == metres)) {
            metres = double(__builtin_inff());
            ++solids.broken_depths;
        }
        if (metres < 0) {
            metres = 0;
            ++solids.negative_depths;
        }
        // What hosts write for "nothing there" is as far as a float reaches.
        solids.camera_depth[i] = metres >= 1e30 ? __builtin_inff() : float(metres);
    }
    return Status::ok();
}

Status read_camera_depth(const Scene& scene, Solids& solids) {
    if (!solids.image) return Status::ok();
    const std::string path = scene_path(scene.directory, scene.camera.depth);
    Image image;
    PILEUS_TRY(read_image(path, image));
    return take_camera_depth(scene.camera, path, image, solids);
}

}  // namespace pileus
