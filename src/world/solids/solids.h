// SPDX-License-Identifier: Apache-2.0
// Solid things of a scene, ready for rays: meshes under one tree of boxes. in: the scene's words,
// the medium's box -> out: Solids, made once and then read only. docs/solids.md.
#pragma once
#include "kernels_cpu/solids/solids_params.h"
#include "src/base/buffer.h"
#include "src/io/meshes/mesh_file.h"
#include "src/plan/plan.h"
#include "src/plan/report.h"
#include "src/run/context.h"
#include "src/scene/scene.h"

namespace pileus {

/// Coordinates stay within this of the medium's box, metres.
constexpr double kMaxSolidMetres = 1e10;

struct Solids {
    bool meshes = false;  ///< the scene has some; the arrays may not be there yet
    Buffer<SolidNode> nodes;
    Buffer<SolidTriangle> triangles;
    Buffer<float> albedo;          ///< [colour][3]: of each solid, then of triangles under maps
    Buffer<float> normals;         ///< [smooth triangle][corner][3]
    std::uint64_t smooth = 0;      ///< triangles that have such
    std::uint64_t degenerate = 0;  ///< triangles without an area, left out
    std::uint64_t file_bytes = 0;  ///< of all files
    std::uint64_t bound = 0;       ///< triangles that these may hold
    bool maps = false;             ///< some have a map of their albedo
    float period[2] = {};          ///< metres after which they repeat along x and y; 0: not

    std::uint64_t bytes() const {
        return nodes.bytes() + triangles.bytes() + albedo.bytes() + normals.bytes();
    }
    bool empty() const { return triangles.empty(); }
    /// Whether any colour is no grey, or may be none.
    bool coloured() const {
        if (maps) return true;
        for (std::size_t i = 0; i + 2 < albedo.size(); i += 3)
            if (albedo[i] != albedo[i + 1] || albedo[i] != albedo[i + 2]) return true;
        return false;
    }
    SolidsView view() const {
        return {nodes.data(),
                triangles.data(),
                albedo.data(),
                normals.empty() ? nullptr : normals.data(),
                std::int32_t(triangles.size()),
                {period[0], period[1]}};
    }
};

struct CameraDepth;

/// What the scene has, from sizes of files alone. kBadInput: a file that is not there; kLimit.
Status outline_solids(const Scene& scene, const Context& context, Solids& solids);

/// Reads the scene's meshes and builds the tree over them, in metres from `low_m`. Errors: those of
/// the readers; kBadInput: too far away; kLimit: a limit, or out of memory.
Status load_solids(const Scene& scene, const Double3& low_m, const Context& context,
                   Solids& solids);

/// Triangles of a mesh in metres from `low_m` as those of solid number `solid`, those without an
/// area left out and counted; from triangles[used] on, and where the mesh has normals from
/// normals[9 smooth] on, which there is room for. `colours`: the row of `albedo` of its first
/// triangle, where each has its own; below 0 all have that of the solid.
Status place_triangles(const SolidSettings& settings, const std::string& name, std::int32_t solid,
                       std::int32_t colours, const Double3& low_m, const Mesh& mesh,
                       std::uint64_t& used, Solids& solids);

/// Reads the mesh of solid number `solid`, or makes one of its map of heights; with normals where
/// it is smooth. Errors: those of the readers.
Status read_solid(const Scene& scene, const Context& context, std::size_t solid, Mesh& mesh);

/// How its corners are placed: maps of heights are in metres and upright already.
SolidSettings placing_of(const SolidSettings& settings);

bool is_smooth(const SolidSettings& settings);

/// The albedo of each triangle from the solid's map, seen from above: `rows` has room for three
/// numbers each. kBadInput: not readable, or values outside of [0, 1]; kLimit.
Status colour_triangles(const SolidSettings& settings, const std::string& path,
                        const Limits& limits, const Mesh& mesh, Span<float> rows);

/// Sorts the triangles under a tree of boxes. kLimit: out of memory.
Status build_solid_tree(Solids& solids);

/// Lets them repeat with a medium of this extent, metres. kBadInput: wider than that.
Status repeat_solids(const Scene& scene, const double (&extent_m)[3], Solids& solids);

/// What the plan says of them; their bytes, bounds where they are not there yet.
void note_solids(const Solids& solids, const CameraDepth& depth, Plan& plan);
/// What methods but `path` know of the media's light on meshes. `nodes`: what comes through nodes
/// over the media's box; `mapped`: what they send to the ground below.
void note_surface_light(const Solids& solids, bool nodes, bool mapped, Plan& plan);
void add_solid_rows(const Scene& scene, const Limits& limits, const Solids& solids,
                    const CameraDepth& depth, MemoryTable& table);
void report_solids(const Solids& solids, const CameraDepth& depth, Report& report);

}  // namespace pileus
