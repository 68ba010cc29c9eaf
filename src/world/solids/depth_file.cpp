// SPDX-License-Identifier: Apache-2.0
// See camera_depth.h: from a file.
#include "src/io/images/picture_layers.h"
#include "src/scene/read_scene.h"
#include "src/world/solids/camera_depth.h"

namespace pileus {
Status read_camera_depth(const Scene& scene, const Context& context, CameraDepth& depth) {
    if (scene.view_files.depth.empty()) return Status::ok();
    const StageClock clock(context, "solids");
    const std::string path = depth_path(scene);
    Image image;
    PILEUS_TRY(at_key(scene, "camera.depth", read_image(path, image)));
    // Nothing is known of the display beyond the pixels of the file: no surface there.
    PILEUS_TRY(at_key(scene, "camera.depth",
                      fit_display_window(path, image, kMaxImagePixels, __builtin_inff())));
    return at_key(scene, "camera.depth",
                  take_camera_depth(scene.camera, scene.view_files, path, image, depth));
}

}  // namespace pileus
