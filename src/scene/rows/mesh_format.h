// SPDX-License-Identifier: Apache-2.0
// The kinds of files that hold a mesh: their extensions, their axes, who reads them.
// in: the table in src/io/meshes/mesh_formats.cpp -> out: rows for checks and readers.
// docs/solids.md, "Files"; docs/contributing.md, "Add a file format".
#pragma once
#include <cstdint>
#include <string>

#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

struct Mesh;

struct MeshFormat {
    const char* extension;  ///< in lower case, with its point
    const char* title;
    bool y_up;  ///< the format's y axis always points up
    Status (*decode)(const std::string& name, Span<const char> bytes, std::uint64_t most_triangles,
                     Mesh& mesh);
};

/// All, in the order of messages.
Span<const MeshFormat> mesh_formats();

/// By the extension of a path, in upper or lower case; null where there is none.
const MeshFormat* mesh_format_of(const std::string& path);

/// ".obj, .ply, ...".
std::string mesh_extensions();

}  // namespace pileus
