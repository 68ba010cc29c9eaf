// SPDX-License-Identifier: Apache-2.0
// See world.h.
#include "src/world/world.h"

#include "src/base/file.h"
#include "src/scene/read_scene.h"

namespace pileus {

Status empty_medium(const Scene& scene, Medium& medium) {
    medium.low_m = scene.camera.target_m;
    for (std::size_t a = 0; a < 3; ++a) {
        medium.extent_m[a] = 1;
        medium.volume.size[a] = medium.grid.size[a] = 1;
        medium.grid.cell_m[a] = 1;
    }
    return medium.volume.density.resize(1, "density");
}

Status read_sky_map(const Scene& scene, const Context& context, SkyMap& map) {
    if (scene.sky.map.empty()) return Status::ok();
    const StageClock clock(context, "sky map");
    InputFile file;
    const std::string path = scene_path(scene.directory, scene.sky.map);
    PILEUS_TRY(at_key(scene, "sky.map", open_file(path, file)));
    PILEUS_TRY(
        at_key(scene, "sky.map", check_limit(context.limits, LimitId::kFile, file.size(), path)));
    return at_key(scene, "sky.map", load_sky_map(scene, map));
}

}  // namespace pileus
