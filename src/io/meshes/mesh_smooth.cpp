// SPDX-License-Identifier: Apache-2.0
// Normals of light for a mesh whose triangles share corners.
// in: corners -> out: a unit normal for each, the same wherever corners have the same place.
// Gouraud 1971, "Continuous shading of curved surfaces"; docs/solids.md, "Smooth normals".
#include <algorithm>
#include <glm/geometric.hpp>

#include "src/io/meshes/mesh_file.h"

namespace pileus {
namespace {

Double3 corner_of(const Mesh& mesh, std::size_t corner) {
    const double* p = &mesh.corners[3 * corner];
    return {p[0], p[1], p[2]};
}

/// Twice the area, along the normal.
Double3 area_of(const Mesh& mesh, std::size_t triangle) {
    const Double3 first = corner_of(mesh, 3 * triangle);
    return glm::cross(corner_of(mesh, 3 * triangle + 1) - first,
                      corner_of(mesh, 3 * triangle + 2) - first);
}

}  // namespace

Status smooth_mesh(Mesh& mesh) {
    const std::uint64_t corners = 3 * mesh.triangles();
    PILEUS_TRY(mesh.normals.resize(3 * corners, "normals"));
    Buffer<std::uint32_t> order;
    PILEUS_TRY(order.resize(corners, "normals"));
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = std::uint32_t(i);
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        const double *p = &mesh.corners[3 * std::size_t(a)], *q = &mesh.corners[3 * std::size_t(b)];
        for (int i = 0; i < 3; ++i)
            if (p[i] != q[i]) return p[i] < q[i];
        return a < b;
    };
    std::sort(order.span().begin(), order.span().end(), before);
    for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
        Double3 sum(0, 0, 0);
        const Double3 place = corner_of(mesh, order[first]);
        for (end = first; end < order.size() && corner_of(mesh, order[end]) == place; ++end)
            sum += area_of(mesh, order[end] / 3);
        const double length = glm::length(sum);
        if (!(length > 0)) continue;
        for (std::size_t i = first; i < end; ++i)
            for (int a = 0; a < 3; ++a)
                mesh.normals[3 * std::size_t(order[i]) + std::size_t(a)] = float(sum[a] / length);
    }
    return Status::ok();
}

}  // namespace pileus
