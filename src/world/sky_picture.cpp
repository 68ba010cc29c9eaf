// SPDX-License-Identifier: Apache-2.0
// See environment.h and sky_map.h: sky maps from files.
// in: .exr or .pfm -> out: SkyMap.
// docs/formats.md "Sky maps in".
#include "src/base/file.h"
#include "src/base/reading_limit.h"
#include "src/io/images/image_file.h"
#include "src/io/images/picture_layers.h"
#include "src/plan/scene_limits.h"
#include "src/scene/read_scene.h"
#include "src/world/environment.h"

namespace pileus {

Status read_sky_image(const Scene& scene, Image& image) {
    const std::string path = scene_path(scene.directory, scene.view_files.sky_map);
    PILEUS_TRY(read_image(path, image, kMaxSkyTexels));
    // A sky is a picture of colours: distances alone are none, whatever else is there.
    const Channel* rgb[3];
    std::string layer;
    if (!color_channels(image, rgb) && image.channels.size() > 1)
        PILEUS_TRY(choose_layer(path, "", image, layer));
    if (!image.foreign.empty()) return Status::bad_input(path + ": " + image.foreign);
    // The sky is the whole display: black where the file has no pixels.
    return fit_display_window(path, image, kMaxSkyTexels);
}

Status load_sky_map(const Scene& scene, SkyMap& map) {
    map.size = {0, 0};
    if (scene.view_files.sky_map.empty()) return Status::ok();
    Image image;
    PILEUS_TRY(read_sky_image(scene, image));
    const std::string path = scene_path(scene.directory, scene.view_files.sky_map);
    return make_sky_map(path, image, scene.sky, scene.ground.present, map);
}

Status read_sky_map(const Scene& scene, const Context& context, const Image* sky, SkyMap& map) {
    if (sky == nullptr && scene.view_files.sky_map.empty()) return Status::ok();
    const StageClock clock(context, "sky map");
    const ReadingLimit readers(context.limits);
    if (sky != nullptr) return make_sky_map("sky.map", *sky, scene.sky, scene.ground.present, map);
    InputFile file;
    const std::string path = scene_path(scene.directory, scene.view_files.sky_map);
    PILEUS_TRY(at_key(scene, "sky.map", open_file(path, file)));
    PILEUS_TRY(
        at_key(scene, "sky.map", check_limit(context.limits, LimitId::kFile, file.size(), path)));
    return at_key(scene, "sky.map", load_sky_map(scene, map));
}

}  // namespace pileus
