// SPDX-License-Identifier: Apache-2.0
// The table of mesh formats.
// in: one row for each -> out: see src/scene/rows/mesh_format.h.
// docs/solids.md, "Files"; docs/contributing.md, "Add a file format".
#include "src/base/file.h"
#include "src/io/meshes/mesh_file.h"
#include "src/scene/rows/mesh_format.h"

namespace pileus {
namespace {

template <bool kBinary>
Status gltf(const std::string& name, Span<const char> bytes, std::uint64_t most_triangles,
            Mesh& mesh) {
    return decode_gltf(name, kBinary, bytes, most_triangles, mesh);
}

constexpr MeshFormat kFormats[] = {{".obj", "Wavefront OBJ", false, decode_obj},
                                   {".ply", "PLY", false, decode_ply},
                                   {".gltf", "glTF", true, gltf<false>},
                                   {".glb", "glTF", true, gltf<true>}};

}  // namespace

Span<const MeshFormat> mesh_formats() { return {kFormats, sizeof kFormats / sizeof kFormats[0]}; }

const MeshFormat* mesh_format_of(const std::string& path) {
    const std::string extension = file_extension(path);
    for (const MeshFormat& format : kFormats)
        if (extension == format.extension) return &format;
    return nullptr;
}

std::string mesh_extensions() {
    std::string list;
    for (const MeshFormat& format : kFormats)
        list += (list.empty() ? "" : ", ") + std::string(format.extension);
    return list;
}

}  // namespace pileus
