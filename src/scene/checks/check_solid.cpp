// SPDX-License-Identifier: Apache-2.0
// Laws between the keys of solid things: meshes, and the camera's image of their distance.
// in: keys that passed their own checks -> out: paths and defaults of the Scene; faults.
// docs/scene.md; docs/solids.md.
#include "src/scene/checks/check_keys.h"
#include "src/scene/frames.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/height_format.h"
#include "src/scene/rows/mesh_format.h"
#include "src/scene/rows/picture_format.h"

namespace pileus {
namespace {

/// What is said of a map of heights, under the path of its solid.
void check_heights(SceneCheck& check, const std::string& path, const Node& file,
                   const HeightFormat& format, const SolidSettings& solid) {
    const auto missing = [&](const std::string& key, const char* allowed) {
        if (check.key(path + key) == nullptr)
            check.faults.add(file.at, path + key,
                             std::string("missing, nothing, allowed: ") + allowed);
    };
    if (!format.placed) missing("bounds_m", "[[x, y], [x, y]], metres");
    if (format.scaled) missing("height_m", "2 numbers, metres, of black and of white");
    if (format.raw) missing("raw_size", "2 whole numbers, columns and rows");
    const bool whole =
        format.whole && (!format.raw || solid.heights.raw_type == HeightType::kUint16);
    if (!whole) conflict(check, path + "height_m", "samples that are heights as they are");
    if (!format.raw)
        for (const char* key : {"raw_size", "raw_type", "raw_endian"})
            conflict(check, path + key, "a map of heights that is no .raw");
    if (check.key(path + "height_m") != nullptr) {
        conflict(check, path + "scale", "height_m, which gives the heights");
        const Node* range = check.valid_key(path + "height_m");
        if (range != nullptr && !(solid.heights.height_m[0] < solid.heights.height_m[1]))
            check.faults.add(range->at, path + "height_m",
                             "inverted or empty, " + value_text(*range) +
                                 ", allowed: 2 numbers, first below second");
    }
    conflict(check, path + "y_up", "a map of heights, which lies flat");
}

void check_albedo_map(SceneCheck& check, const std::string& path, SolidSettings& solid) {
    const std::string key = path + "albedo_map";
    if (check.key(key) == nullptr) {
        conflict(check, path + "albedo_map_scale", "a solid without albedo_map");
        return;
    }
    conflict(check, path + "albedo", "albedo_map, which has the colours");
    if (const Node* map = check.valid_key(key))
        check_picture(check, *map, key.c_str(), is_read, solid.albedo_map);
}

void check_solid(SceneCheck& check, std::size_t index) {
    SolidSettings& solid = check.scene.solids[index];
    const std::string path = "solid." + std::to_string(index) + ".";
    check_albedo_map(check, path, solid);
    const Node* file = check.valid_key(path + "file");
    if (file == nullptr || !check_path(check, *file, (path + "file").c_str(), solid.file)) return;
    if (const HeightFormat* heights = height_format_of(solid.file))
        return check_heights(check, path, *file, *heights, solid);
    for (const char* key :
         {"bounds_m", "height_m", "holes", "every", "raw_size", "raw_type", "raw_endian"})
        conflict(check, path + key, "a mesh, which is no map of heights");
    const MeshFormat* format = mesh_format_of(solid.file);
    if (format == nullptr)
        check.faults.add(file->at, path + "file",
                         "unknown kind of mesh, " + value_text(*file) +
                             ", allowed: " + mesh_extensions() + ", " + height_extensions());
    if (format == nullptr || !format->y_up) return;
    if (check.written) conflict(check, path + "y_up", "glTF, whose y axis always points up");
    solid.y_up = true;
}

void check_depth(SceneCheck& check) {
    std::string& depth = check.scene.view_files.depth;
    if (check.key("camera.depth") == nullptr) {
        for (const char* key : {"camera.depth_kind", "camera.depth_scale"})
            conflict(check, key, "a camera without depth");
        return;
    }
    if (check.scene.camera.flux) conflict(check, "camera.depth", "projection \"flux\"");
    const char* mover = is_sequence(depth) ? nullptr : mover_of_view(check.scene);
    if (mover != nullptr)
        conflict(check, mover, "camera.depth, which one camera sees where its name has no #");
    if (const Node* file = check.valid_key("camera.depth"))
        check_picture(check, *file, "camera.depth", is_radiance, depth);
}

}  // namespace

void check_solids(SceneCheck& check) {
    check_depth(check);
    for (std::size_t i = 0; i < check.scene.solids.size(); ++i) check_solid(check, i);
}

}  // namespace pileus
