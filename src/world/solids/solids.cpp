// SPDX-License-Identifier: Apache-2.0
// See solids.h. Meshes: read, turned, placed; solid_tree.cpp sorts them.
#include "src/world/solids/solids.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "src/base/angles.h"
#include "src/base/file.h"
#include "src/base/number_text.h"
#include "src/io/heights/height_map.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/height_format.h"
#include "src/scene/toml/toml_tree.h"
#include "src/world/solids/camera_depth.h"

namespace pileus {
namespace {

/// Bytes that the reader of meshes takes for each of a file's (measured: docs/solids.md).
constexpr std::uint64_t kReadingFactor = 12;

/// Axes of the file onto axes of the world: about x, then y, then z. Written by columns.
glm::dmat3 turn_of(const SolidSettings& s) {
    const SineCosine x = sincos_deg(s.rotation_deg[0]), y = sincos_deg(s.rotation_deg[1]),
                     z = sincos_deg(s.rotation_deg[2]);
    const glm::dmat3 about_x(1, 0, 0, 0, x.cosine, x.sine, 0, -x.sine, x.cosine);
    const glm::dmat3 about_y(y.cosine, 0, -y.sine, 0, 1, 0, y.sine, 0, y.cosine);
    const glm::dmat3 about_z(z.cosine, z.sine, 0, -z.sine, z.cosine, 0, 0, 0, 1);
    const glm::dmat3 all = about_z * (about_y * about_x);
    if (!s.y_up) return all;
    return all * glm::dmat3(1, 0, 0, 0, 0, 1, 0, -1, 0);
}

template <class Number>
Double3 vector_of(const Number* p) {
    return {double(p[0]), double(p[1]), double(p[2])};
}

/// Fills the unit normal; false where there is none.
bool set_normal(SolidTriangle& t) {
    const Double3 first = vector_of(t.corner[0]);
    const Double3 n = glm::cross(vector_of(t.corner[1]) - first, vector_of(t.corner[2]) - first);
    const double length = glm::length(n);
    if (!(length > 0)) return false;
    for (int a = 0; a < 3; ++a) t.normal[a] = float(n[a] / length);
    return true;
}

std::string file_key(std::size_t solid) { return "solid." + std::to_string(solid) + ".file"; }

Status read_all(const Scene& scene, const Context& context, std::vector<Mesh>& meshes) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < scene.solids.size(); ++i) {
        PILEUS_TRY(read_solid(scene, context, i, meshes[i]));
        sum += meshes[i].triangles();
        PILEUS_TRY(at_key(scene, file_key(i),
                          check_limit(context.limits, LimitId::kTriangles, sum,
                                      scene_path(scene.directory, scene.solids[i].file))));
    }
    return Status::ok();
}

/// Normals of light at a triangle's corners, turned with it; flat where they face its other side.
void add_normals(const glm::dmat3& turn, const float* from, SolidTriangle& t, Solids& solids) {
    float* to = &solids.normals[9 * std::size_t(solids.smooth++)];
    t.smooth = std::int32_t(solids.smooth);
    for (int i = 0; i < 3; ++i) {
        const Double3 n = turn * vector_of(from + 3 * i);
        const bool faces = glm::dot(n, vector_of(t.normal)) > 0;
        for (int a = 0; a < 3; ++a) to[3 * i + a] = faces ? float(n[a]) : t.normal[a];
    }
}

/// Rooms for all triangles, their normals and the colours of those under maps.
Status make_room(const Scene& scene, const std::vector<Mesh>& meshes, Solids& solids) {
    std::uint64_t sum = 0, smooth = 0, mapped = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        sum += meshes[i].triangles();
        if (!meshes[i].normals.empty()) smooth += meshes[i].triangles();
        if (!scene.solids[i].albedo_map.empty()) mapped += meshes[i].triangles();
    }
    PILEUS_TRY(solids.triangles.resize(sum, "triangles"));
    if (smooth > 0) PILEUS_TRY(solids.normals.resize(9 * smooth, "normals of solids"));
    if (mapped == 0) return Status::ok();
    Buffer<float> colours;
    PILEUS_TRY(colours.resize(3 * (scene.solids.size() + mapped), "colours of solids"));
    std::copy_n(solids.albedo.data(), 3 * scene.solids.size(), colours.data());
    solids.albedo.swap(colours);
    return Status::ok();
}

}  // namespace

Status place_triangles(const SolidSettings& settings, const std::string& name, std::int32_t solid,
                       std::int32_t colours, const Double3& low_m, const Mesh& mesh,
                       std::uint64_t& used, Solids& solids) {
    const Span<const double> corners = mesh.corners.span();
    const glm::dmat3 turn = turn_of(settings);
    const Double3 shift = settings.position_m - low_m;
    for (std::size_t at = 0; at + 9 <= corners.size; at += 9) {
        SolidTriangle t{};
        t.number = std::int32_t(used + solids.degenerate);
        t.solid = solid;
        t.colour = colours < 0 ? solid : colours + std::int32_t(at / 9);
        for (std::size_t i = 0; i < 3; ++i) {
            const Double3 p = vector_of(corners.data + at + 3 * i);
            const Double3 placed = turn * p * settings.scale + shift;
            for (int r = 0; r < 3; ++r) {
                if (!(placed[r] >= -kMaxSolidMetres && placed[r] <= kMaxSolidMetres))
                    return Status::bad_input(name + ": mesh: triangle " + std::to_string(at / 9) +
                                             ": too far away, allowed: within 1e10 m of the media");
                t.corner[i][r] = float(placed[r]);
            }
        }
        if (!set_normal(t)) {
            ++solids.degenerate;
            continue;
        }
        if (!mesh.normals.empty()) add_normals(turn, &mesh.normals[at], t, solids);
        solids.triangles[std::size_t(used++)] = t;
    }
    return Status::ok();
}

Status outline_solids(const Scene& scene, const Context& context, Solids& solids) {
    solids = Solids();
    solids.meshes = !scene.solids.empty();
    PILEUS_TRY(solids.albedo.resize(3 * scene.solids.size(), "colours of solids"));
    for (std::size_t i = 0; i < solids.albedo.size(); ++i)
        solids.albedo[i] = scene.solids[i / 3].albedo[i % 3];
    for (std::size_t i = 0; i < scene.solids.size(); ++i) {
        solids.maps |= !scene.solids[i].albedo_map.empty();
        InputFile file;
        const std::string path = scene_path(scene.directory, scene.solids[i].file);
        PILEUS_TRY(at_key(scene, file_key(i), open_file(path, file)));
        PILEUS_TRY(at_key(scene, file_key(i),
                          check_limit(context.limits, LimitId::kFile, file.size(), path)));
        solids.file_bytes += file.size();
        // A face takes at least two bytes of a mesh.
        std::uint64_t most = file.size() / 2;
        if (height_format_of(path) != nullptr)
            PILEUS_TRY(at_key(scene, file_key(i),
                              bound_heights(path, file.size(), scene.solids[i].heights, most)));
        solids.bound += std::min(most, context.limits[LimitId::kTriangles]);
    }
    return Status::ok();
}

Status load_solids(const Scene& scene, const Double3& low_m, const Context& context,
                   Solids& solids) {
    if (!solids.meshes) return Status::ok();
    const StageClock clock(context, "solids");
    std::vector<Mesh> meshes(scene.solids.size());
    PILEUS_TRY(read_all(scene, context, meshes));
    PILEUS_TRY(make_room(scene, meshes, solids));
    std::uint64_t used = 0;
    std::size_t colours = meshes.size();  // rows of `albedo` that are taken
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const SolidSettings& settings = scene.solids[i];
        const bool mapped = !settings.albedo_map.empty();
        if (mapped) {
            const Span<float> rows =
                solids.albedo.span().part(3 * colours, 3 * std::size_t(meshes[i].triangles()));
            PILEUS_TRY(
                at_key(scene, "solid." + std::to_string(i) + ".albedo_map",
                       colour_triangles(settings, scene_path(scene.directory, settings.albedo_map),
                                        context.limits, meshes[i], rows)));
        }
        PILEUS_TRY(
            at_key(scene, file_key(i),
                   place_triangles(placing_of(settings), scene_path(scene.directory, settings.file),
                                   std::int32_t(i), mapped ? std::int32_t(colours) : -1, low_m,
                                   meshes[i], used, solids)));
        if (mapped) colours += std::size_t(meshes[i].triangles());
        meshes[i] = Mesh();
    }
    solids.triangles.truncate(std::size_t(used));
    return build_solid_tree(solids);
}

Status repeat_solids(const Scene& scene, const double (&extent_m)[3], Solids& solids) {
    if (solids.triangles.empty()) return Status::ok();
    const SolidNode& all = solids.nodes[0];
    for (int a = 0; a < 2; ++a) {
        // Corners are rounded one by one: what is as wide as a period may be a little wider.
        const double wide = double(all.high[a]) - double(all.low[a]);
        if (wide > extent_m[a] * (1 + 1e-6))
            return at_key(scene, "solid.0.file",
                          Status::bad_input("all solids together are " + number_text(wide) +
                                            " m wide along " + (a == 0 ? "x" : "y") +
                                            ", allowed: at most a period of the medium, " +
                                            number_text(extent_m[a]) + " m"));
        solids.period[a] = float(extent_m[a]);
    }
    return Status::ok();
}

void note_solids(const Solids& solids, const CameraDepth& depth, Plan& plan) {
    if (solids.meshes)
        plan.need("solid meshes: rays against triangles");
    else
        plan.leave_out("rays against triangles", "no solid");
    if (depth.present) plan.need("the camera's depth image");
}

void note_surface_light(const Solids& solids, bool nodes, bool mapped, Plan& plan) {
    if (!solids.meshes) return;
    if (nodes) plan.need("light between media and solids within their box, by nodes");
    if (mapped)
        plan.need("light of media on other solids, as on the ground below them: approximation");
    else
        plan.leave_out(nodes
                           ? "the sky that media hide from solids outside of their box"
                           : "the sky that media hide from solids, and light that they send there",
                       nodes ? "no ground with an albedo" : "no discrete ordinates over a box");
}

void add_solid_rows(const Scene& scene, const Limits& limits, const Solids& solids,
                    const CameraDepth& depth, MemoryTable& table) {
    // The tree has less than two nodes a triangle.
    const std::uint64_t bound = std::min(solids.bound, limits[LimitId::kTriangles]);
    const bool known = !solids.triangles.empty();
    const std::uint64_t n = known ? solids.triangles.size() : bound;
    table.add("triangles", Stage::kDensity, Stage::kWrite, bytes_of(n, sizeof(SolidTriangle)));
    // What sorting needs, and the file as its reader keeps it, go with the stage.
    table.add("tree of solids", Stage::kDensity, Stage::kWrite, bytes_of(2 * n, sizeof(SolidNode)));
    table.add(
        "reading solids", Stage::kDensity, Stage::kDensity,
        bytes_of(kReadingFactor, solids.file_bytes) + bytes_of(n, sizeof(SolidTriangle) + 64));
    bool smooth = false;
    for (const SolidSettings& solid : scene.solids) smooth |= is_smooth(solid);
    if (smooth)
        table.add("normals of solids", Stage::kDensity, Stage::kWrite,
                  known ? solids.normals.bytes() : bytes_of(n, 9 * sizeof(float)));
    if (solids.maps)
        table.add("colours of solids", Stage::kDensity, Stage::kWrite,
                  known ? solids.albedo.bytes() : bytes_of(n, 3 * sizeof(float)));
    const std::uint64_t pixels =
        std::uint64_t(scene.camera.resolution[0]) * std::uint64_t(scene.camera.resolution[1]);
    table.add("camera depth", Stage::kDensity, Stage::kWrite,
              depth.present ? pixels * sizeof(float) : 0);
}

void report_solids(const Solids& solids, const CameraDepth& depth, Report& report) {
    if (!solids.meshes && !depth.present) return;
    report.executed.emplace_back("triangles", solids.triangles.size());
    report.executed.emplace_back("solid_nodes", solids.nodes.size());
    report.counters.emplace_back("degenerate_triangles", solids.degenerate);
    if (!depth.present) return;
    report.counters.emplace_back("depths_not_numbers", depth.broken);
    report.counters.emplace_back("depths_negative", depth.negative);
}

}  // namespace pileus
