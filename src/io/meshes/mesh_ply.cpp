// SPDX-License-Identifier: Apache-2.0
// Reads the faces of a PLY file.
// in: elements vertex (x, y, z) and face (vertex_indices) among others -> out: triangles.
// Turk 1994, "The PLY polygon file format"; docs/solids.md, "Files".
#include "src/io/meshes/mesh_file.h"
#include "src/io/text/ply_file.h"

namespace pileus {
namespace {

constexpr const char* kNoIndex = "face: no such vertex or length";

class Reader : private PlyFile {
public:
    Reader(const std::string& file, Span<const char> text) : PlyFile(file, text) {}

    Status header();
    /// Reads the elements; without `mesh` counts triangles only.
    Status body(std::uint64_t& triangles, Buffer<double>& places, Mesh* mesh);
    std::uint64_t vertices() const { return count_of("vertex"); }

private:
    Status item(const PlyElement& e, std::uint64_t number, std::uint64_t& triangles,
                Buffer<double>& places, Mesh* mesh);
    Status list(const PlyProperty& p, bool faces, std::uint64_t& triangles,
                const Buffer<double>& places, Mesh* mesh);
};

Status Reader::header() {
    PILEUS_TRY(read_head());
    for (const PlyElement& e : elements())
        if (e.name == "vertex") PILEUS_TRY(need_axes(e));
    return Status::ok();
}

Status Reader::list(const PlyProperty& p, bool faces, std::uint64_t& triangles,
                    const Buffer<double>& places, Mesh* mesh) {
    std::uint64_t length = 0, first = 0, last = 0, next = 0;
    PILEUS_TRY(index(p.count, text_.size + 1, kNoIndex, length));
    for (std::uint64_t i = 0; i < length; ++i, last = next) {
        double ignored = 0;
        if (!faces) {
            PILEUS_TRY(value(p.type, ignored));
            continue;
        }
        PILEUS_TRY(index(p.type, vertices(), kNoIndex, next));
        if (i == 0) first = next;
        if (i < 2) continue;
        if (mesh != nullptr) {
            double* to = mesh->corners.span().part(std::size_t(9 * triangles), 9).data;
            for (std::uint64_t v : {first, last, next})
                for (std::size_t a = 0; a < 3; ++a) *to++ = places.at(std::size_t(3 * v) + a);
        }
        ++triangles;
    }
    return Status::ok();
}

Status Reader::item(const PlyElement& e, std::uint64_t number, std::uint64_t& triangles,
                    Buffer<double>& places, Mesh* mesh) {
    static const char* const axes[3] = {"x", "y", "z"};
    const bool vertex = e.name == "vertex", face = e.name == "face";
    for (const PlyProperty& p : e.properties) {
        if (p.count != PlyType::kNone) {
            const bool corners = p.name == "vertex_indices" || p.name == "vertex_index";
            PILEUS_TRY(list(p, face && corners, triangles, places, mesh));
            continue;
        }
        const std::size_t begin = rest_.at;
        double v = 0;
        PILEUS_TRY(value(p.type, v));
        for (std::size_t a = 0; a < 3 && vertex; ++a) {
            if (p.name != axes[a]) continue;
            if (!(v >= -kMaxCoordinate && v <= kMaxCoordinate))
                return fault(begin,
                             "vertex: not a number or out of range, allowed: number in "
                             "[-1e12, 1e12]");
            places.at(std::size_t(3 * number) + a) = v;
        }
    }
    return Status::ok();
}

Status Reader::body(std::uint64_t& triangles, Buffer<double>& places, Mesh* mesh) {
    triangles = 0;
    rewind();
    for (const PlyElement& e : elements()) {
        if (e.properties.empty()) continue;
        for (std::uint64_t i = 0; i < e.count; ++i) PILEUS_TRY(item(e, i, triangles, places, mesh));
    }
    return Status::ok();
}

}  // namespace

Status decode_ply(const std::string& name, Span<const char> bytes, std::uint64_t most_triangles,
                  Mesh& mesh) {
    Reader reader(name, bytes);
    PILEUS_TRY(reader.header());
    Buffer<double> places;
    PILEUS_TRY(places.resize(3 * reader.vertices(), "vertices"));
    std::uint64_t triangles = 0;
    PILEUS_TRY(reader.body(triangles, places, nullptr));
    PILEUS_TRY(check_triangles(name, triangles, most_triangles));
    PILEUS_TRY(mesh.corners.resize(9 * triangles, "mesh"));
    return reader.body(triangles, places, &mesh);
}

}  // namespace pileus
