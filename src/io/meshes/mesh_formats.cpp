// SPDX-License-Identifier: Apache-2.0
// The table of mesh formats, and the reader for each extension.
// in: one row for each -> out: see src/scene/rows/mesh_format.h, mesh_file.h.
// docs/solids.md, "Files"; docs/contributing.md, "Add a file format".
#include "src/base/file.h"
#include "src/io/meshes/mesh_file.h"
#include "src/scene/rows/mesh_format.h"

namespace pileus {

Status check_triangles(const std::string& name, std::uint64_t triangles, std::uint64_t most) {
    if (triangles == 0)
        return Status::bad_input(name + ": mesh: no triangles, allowed: one or more");
    if (triangles <= most) return Status::ok();
    return Status::limit(name + ": limits.triangles: needs " + std::to_string(triangles) +
                         ", allowed: at most " + std::to_string(most) + " (--limit triangles=...)");
}

Status decode_mesh(const std::string& name, const std::string& extension, Span<const char> bytes,
                   std::uint64_t most_triangles, Mesh& mesh) {
    const MeshFormat* format = mesh_format_of("mesh" + extension);
    if (format != nullptr) return format->decode(name, bytes, most_triangles, mesh);
    return Status::bad_input(name + ": mesh: unknown kind of file, " + extension +
                             ", allowed: " + mesh_extensions());
}

Status read_mesh(const std::string& path, const Limits& limits, Mesh& mesh) {
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, limits[LimitId::kFile], bytes));
    return decode_mesh(path, file_extension(path), bytes.span(), limits[LimitId::kTriangles], mesh);
}

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
    return row_of_extension(kFormats, path);
}

std::string mesh_extensions() {
    return extensions_of(kFormats, ", ", [](const MeshFormat&) { return true; });
}

}  // namespace pileus
