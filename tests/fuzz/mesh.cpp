// SPDX-License-Identifier: Apache-2.0
// Fuzz target: meshes as OBJ or PLY, by what the bytes begin with.
// in: bytes as a mesh -> out: triangles with finite corners, or one line.
// docs/solids.md, "Files"
#include "src/io/meshes/mesh_file.h"
#include "tests/fuzz/target.h"

int fuzz::mesh(const std::uint8_t* data, std::size_t size) {
    constexpr std::uint64_t kMaxTriangles = 1 << 16;
    const bool ply = size >= 3 && data[0] == 'p' && data[1] == 'l' && data[2] == 'y';
    pileus::Mesh mesh;
    const pileus::Status status = pileus::decode_mesh(
        "m.x", ply ? ".ply" : ".obj", fuzz::text_of(data, size), kMaxTriangles, mesh);
    if (!status) {
        fuzz::check_fault(status, "m.x:", true);
        return 0;
    }
    fuzz::require(mesh.triangles() > 0 && mesh.triangles() <= kMaxTriangles, "as many as allowed");
    for (double v : mesh.corners.span())
        fuzz::require(v >= -pileus::kMaxCoordinate && v <= pileus::kMaxCoordinate,
                      "corners are finite");
    return 0;
}
