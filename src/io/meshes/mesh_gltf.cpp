// SPDX-License-Identifier: Apache-2.0
// See mesh_file.h. Reading goes through the library Assimp, which is loaded when a scene has a
// mesh. in: a scene of its C interface, trusted in nothing -> out: corners. The only file that
// touches the library; docs/solids.md, "Files".
#include "src/base/printable.h"
#include "src/io/meshes/mesh_file.h"

#ifdef PILEUS_WITH_ASSIMP
#include <assimp/cimport.h>
#include <assimp/scene.h>

#include <cstring>
#include <vector>

#include "src/base/dynamic_library.h"
#endif

namespace pileus {

#ifdef PILEUS_WITH_ASSIMP
namespace {

constexpr std::size_t kMaxNodes = std::size_t{1} << 20;

/// Row-major; the last row is always 0 0 0 1.
struct Placement {
    double m[3][4];
};

Placement operator*(const Placement& a, const Placement& b) {
    Placement out{};
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c) {
            out.m[r][c] = c == 3 ? a.m[r][3] : 0.0;
            for (int i = 0; i < 3; ++i) out.m[r][c] += a.m[r][i] * b.m[i][c];
        }
    return out;
}

Placement placement_of(const aiMatrix4x4& m) {
    return {{{double(m.a1), double(m.a2), double(m.a3), double(m.a4)},
             {double(m.b1), double(m.b2), double(m.b3), double(m.b4)},
             {double(m.c1), double(m.c2), double(m.c3), double(m.c4)}}};
}

/// The library while one file is read.
struct Library {
    decltype(&aiImportFile) from_file = nullptr;
    decltype(&aiImportFileFromMemory) from_memory = nullptr;
    decltype(&aiReleaseImport) release = nullptr;
    decltype(&aiGetErrorString) error = nullptr;

    bool load() {
        DynamicLibrary library("libassimp.so.5");
        library.find("aiImportFile", from_file);
        library.find("aiImportFileFromMemory", from_memory);
        library.find("aiReleaseImport", release);
        library.find("aiGetErrorString", error);
        return library.is_whole();
    }
};

/// Walks the scene's nodes and hands out the triangles of each mesh where it stands.
class Triangles {
public:
    Triangles(const std::string& name, const aiScene& scene) : name_(name), scene_(scene) {}

    /// Counts them, or with `mesh` stores them.
    Status walk(Mesh* mesh);
    std::uint64_t count() const { return count_; }

private:
    Status fault(const std::string& text) const {
        return Status::bad_input(name_ + ": mesh: " + text);
    }
    Status add_mesh(const aiMesh& from, const Placement& place, Mesh* mesh);
    Status add_corner(const aiMesh& from, unsigned index, const Placement& place, double* to) const;

    const std::string& name_;
    const aiScene& scene_;
    std::uint64_t count_ = 0;
};

Status Triangles::add_corner(const aiMesh& from, unsigned index, const Placement& place,
                             double* to) const {
    if (index >= from.mNumVertices)
        return fault("no such vertex, " + std::to_string(index) + ", allowed: below " +
                     std::to_string(from.mNumVertices));
    const aiVector3D& v = from.mVertices[index];
    const double at[3] = {double(v.x), double(v.y), double(v.z)};
    for (int r = 0; r < 3; ++r) {
        const double* m = place.m[r];
        const double x = m[0] * at[0] + m[1] * at[1] + m[2] * at[2] + m[3];
        if (!(x >= -kMaxCoordinate && x <= kMaxCoordinate))
            return fault("vertex " + std::to_string(index) +
                         ": not a number or too far away, allowed: -1e12 to 1e12");
        to[r] = x;
    }
    return Status::ok();
}

Status Triangles::add_mesh(const aiMesh& from, const Placement& place, Mesh* mesh) {
    if (from.mNumFaces > 0 && (from.mFaces == nullptr || from.mVertices == nullptr))
        return fault("faces without vertices, allowed: both");
    for (unsigned f = 0; f < from.mNumFaces; ++f) {
        const aiFace& face = from.mFaces[f];
        if (face.mNumIndices < 3 || face.mIndices == nullptr) continue;  // points and lines
        for (unsigned i = 2; i < face.mNumIndices; ++i, ++count_) {
            if (mesh == nullptr) {
                continue;
            }
            double* to = mesh->corners.span().part(std::size_t(9 * count_), 9).data;
            PILEUS_TRY(add_corner(from, face.mIndices[0], place, to));
            PILEUS_TRY(add_corner(from, face.mIndices[i - 1], place, to + 3));
            PILEUS_TRY(add_corner(from, face.mIndices[i], place, to + 6));
        }
    }
    return Status::ok();
}

Status Triangles::walk(Mesh* mesh) {
    struct Item {
        const aiNode* node;
        Placement place;
    };
    count_ = 0;
    std::size_t seen = 0;
    std::vector<Item> stack;
    if (scene_.mRootNode != nullptr)
        stack.push_back({scene_.mRootNode, placement_of(scene_.mRootNode->mTransformation)});
    while (!stack.empty()) {
        const Item item = stack.back();
        stack.pop_back();
        if (++seen > kMaxNodes) return fault("too many nodes, allowed: up to 1048576");
        for (unsigned i = 0; i < item.node->mNumMeshes; ++i) {
            const unsigned index = item.node->mMeshes[i];
            if (index >= scene_.mNumMeshes) return fault("a node names a mesh that is not there");
            PILEUS_TRY(add_mesh(*scene_.mMeshes[index], item.place, mesh));
        }
        // Children in the file's order: the last one is pushed first.
        for (unsigned i = item.node->mNumChildren; i-- > 0;) {
            const aiNode* child = item.node->mChildren[i];
            stack.push_back({child, item.place * placement_of(child->mTransformation)});
        }
    }
    return Status::ok();
}

Status take_triangles(const std::string& name, const aiScene& scene, std::uint64_t most,
                      Mesh& mesh) {
    Triangles triangles(name, scene);
    PILEUS_TRY(triangles.walk(nullptr));
    PILEUS_TRY(check_triangles(name, triangles.count(), most));
    PILEUS_TRY(mesh.corners.resize(9 * triangles.count(), "mesh"));
    return triangles.walk(&mesh);
}

}  // namespace

Status decode_gltf(const std::string& name, bool binary, Span<const char> bytes,
                   std::uint64_t most_triangles, Mesh& mesh) {
    Library library;
    if (!library.load())
        return Status::bad_input(name +
                                 ": mesh: libassimp.so.5 is not installed, allowed: install it, "
                                 "or a .ply or .obj");
    // The library ends the program over a file without a beginning: look at it first.
    const char* head = binary ? "glTF" : "{";
    if (!binary && without_mark(bytes).size < bytes.size)
        return Status::bad_input(name +
                                 ": mesh: a mark of UTF-8 before the text, allowed: none, as "
                                 "glTF has it");
    const std::size_t length = binary ? 20 : 2;
    if (bytes.size < length || bytes.size > 0xffffffffu ||
        std::memcmp(bytes.data, head, std::strlen(head)) != 0)
        return Status::bad_input(name + ": mesh: no glTF, allowed: a file that begins with \"" +
                                 head + "\"");
    const aiScene* scene =
        binary ? library.from_memory(bytes.data, unsigned(bytes.size), 0, "glb")
               : library.from_file(name.c_str(), 0);  // its buffers may lie in other files
    if (scene == nullptr)
        return Status::bad_input(name + ": mesh: cannot be read, " +
                                 printable_line(library.error()) + ", allowed: a whole glTF file");
    Status status = take_triangles(name, *scene, most_triangles, mesh);
    library.release(scene);
    return status;
}
#else
Status decode_gltf(const std::string& name, bool, Span<const char>, std::uint64_t, Mesh&) {
    return Status::bad_input(name +
                             ": mesh: this build reads no glTF (PILEUS_ASSIMP), allowed: a .ply or "
                             ".obj");
}
#endif

}  // namespace pileus
