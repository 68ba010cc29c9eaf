// SPDX-License-Identifier: Apache-2.0
// Meshes from files that nobody has checked: triangles, and nothing else of what they hold; normals
// that light may take are our own.
// in: .obj .ply .gltf .glb -> out: corners in the file's own units and axes.
// docs/solids.md, "Files".
#pragma once
#include <cstdint>
#include <string>

#include "src/base/buffer.h"
#include "src/base/limits.h"
#include "src/base/span.h"

namespace pileus {

struct Mesh {
    /// [triangle][corner][axis], all finite; in doubles, since places on a map are far from its 0.
    Buffer<double> corners;
    /// Of light, [triangle][corner][axis], unit or 0; empty: none.
    Buffer<float> normals;

    std::uint64_t triangles() const { return corners.size() / 9; }
};

/// Coordinates of a file stay within this, either way.
constexpr double kMaxCoordinate = 1e12;

/// Reads all triangles; polygons become fans of them around their first corner. Missing, malformed,
/// without triangles, or a build that cannot read meshes: kBadInput; over the limits `file` and
/// `triangles`, or out of memory: kLimit.
Status read_mesh(const std::string& path, const Limits& limits, Mesh& mesh);

/// The same from the bytes of a file; `extension` says which kind. A .gltf finds its other files
/// beside `name`.
Status decode_mesh(const std::string& name, const std::string& extension, Span<const char> bytes,
                   std::uint64_t most_triangles, Mesh& mesh);

// One file per format.
Status decode_obj(const std::string& name, Span<const char> bytes, std::uint64_t most_triangles,
                  Mesh& mesh);
Status decode_ply(const std::string& name, Span<const char> bytes, std::uint64_t most_triangles,
                  Mesh& mesh);
/// By a library that is loaded for it; `binary`: a .glb.
Status decode_gltf(const std::string& name, bool binary, Span<const char> bytes,
                   std::uint64_t most_triangles, Mesh& mesh);

/// Normals of light at all corners: the mean of the triangles that share a corner's place, each as
/// heavy as its area. kLimit: out of memory.
Status smooth_mesh(Mesh& mesh);

/// kBadInput where there is none, kLimit where there are too many.
Status check_triangles(const std::string& name, std::uint64_t triangles, std::uint64_t most);

}  // namespace pileus
