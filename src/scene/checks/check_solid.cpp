// SPDX-License-Identifier: Apache-2.0
// Laws between the keys of solid things: meshes, and the camera's image of their distance.
// in: keys that passed their own checks -> out: paths and defaults of the Scene; faults.
// docs/scene.md; docs/solids.md.
#include "src/scene/checks/check_keys.h"
#include "src/scene/frames.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/mesh_format.h"
#include "src/scene/rows/picture_format.h"

namespace pileus {
namespace {

void check_solid(SceneCheck& check, std::size_t index) {
    SolidSettings& solid = check.scene.solids[index];
    const std::string path = "solid." + std::to_string(index) + ".";
    const Node* file = check.valid_key(path + "file");
    if (file == nullptr || !check_path(check, *file, (path + "file").c_str(), solid.file)) return;
    const MeshFormat* format = mesh_format_of(solid.file);
    if (format == nullptr)
        check.faults.add(
            file->at, path + "file",
            "unknown kind of mesh, " + value_text(*file) + ", allowed: " + mesh_extensions());
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
    const Node* file = check.valid_key("camera.depth");
    if (file == nullptr || !check_path(check, *file, "camera.depth", depth)) return;
    const PictureFormat* format = picture_format_of(depth);
    if (format == nullptr || !is_radiance(*format))
        check.faults.add(file->at, "camera.depth",
                         "unknown kind of picture, " + value_text(*file) +
                             ", allowed: " + picture_extensions(is_radiance));
}

}  // namespace

void check_solids(SceneCheck& check) {
    check_depth(check);
    for (std::size_t i = 0; i < check.scene.solids.size(); ++i) check_solid(check, i);
}

}  // namespace pileus
