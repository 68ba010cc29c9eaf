// SPDX-License-Identifier: Apache-2.0
// See node_grid.h.
#include "src/picture/nodes/node_grid.h"

#include <algorithm>

#include "kernels_cpu/core/lanes.h"

namespace pileus {
namespace {

/// Spacings of the nodes that near ones reach from the camera: from there on the line from a node
/// to the camera and a ray past it differ by less than bands can tell (docs/collectors.md).
constexpr int kNearReach = 6;

float widest_spacing(const NodeGrid& g) {
    float widest = 0;
    for (float per_metre : g.per_metre) widest = std::max(widest, 1.0f / per_metre);
    return widest;
}

}  // namespace

NodeGrid make_node_grid(const Grid& grid, const double (&extent_m)[3], double spacing_m) {
    NodeGrid g{};
    for (int a = 0; a < 3; ++a) {
        const double wanted = spacing_m > 0 ? extent_m[a] / spacing_m + 0.5 : 1;
        int n = wanted > grid.size[a] ? grid.size[a] : int(wanted);
        if (n < 1) n = 1;
        g.size[a] = n;
        g.per_metre[a] = float(n / extent_m[a]);
    }
    return g;
}

NodeGrid make_layered_grid(const Grid& grid, const double (&extent_m)[3], double extinction_per_m,
                           double spacing_m, double budget) {
    constexpr double kMaxLayers = 24;
    double fewest[3];
    for (int a = 0; a < 3; ++a) {
        // Nodes are two voxels apart at the nearest.
        const double most = grid.size[a] < 2 * kMaxLayers ? 0.5 * grid.size[a] : kMaxLayers;
        fewest[a] = layers_of_depth(extent_m[a] * extinction_per_m, most);
    }
    const auto nodes_along = [&](int a, double spacing) {
        const double cubes = extent_m[a] / spacing;
        const double nodes = cubes > fewest[a] ? cubes : fewest[a];
        return nodes < grid.size[a] ? nodes : double(grid.size[a]);
    };
    const auto count = [&](double spacing) {
        return nodes_along(0, spacing) * nodes_along(1, spacing) * nodes_along(2, spacing);
    };
    while (count(spacing_m) > budget) spacing_m *= 1.25;
    NodeGrid g{};
    for (int a = 0; a < 3; ++a) {
        const int n = int(nodes_along(a, spacing_m) + 0.5);
        g.size[a] = n < 1 ? 1 : n;
        g.per_metre[a] = float(g.size[a] / extent_m[a]);
    }
    return g;
}

NodeGrid make_sized_grid(const int (&size)[3], const double (&extent_m)[3]) {
    NodeGrid g{};
    for (int a = 0; a < 3; ++a) {
        g.size[a] = size[a];
        g.per_metre[a] = float(size[a] / extent_m[a]);
    }
    return g;
}

NodeGrid make_half_grid(const Grid& grid, const double (&extent_m)[3]) {
    int size[3];
    for (int a = 0; a < 3; ++a) size[a] = (grid.size[a] + 1) / 2;
    return make_sized_grid(size, extent_m);
}

NearNodes near_nodes(const NodeGrid& g, const float (&camera)[3]) {
    NearNodes out{};
    const float widest = widest_spacing(g);
    NearNodes near{};
    near.reach = float(kNearReach) * widest;
    near.every = widest;
    for (int a = 0; a < 3; ++a) {
        // Both nodes beside the last place that counts; far from the grid floats know no node.
        const float low = (camera[a] - near.reach) * g.per_metre[a] - 0.5f;
        const float high = (camera[a] + near.reach) * g.per_metre[a] - 0.5f;
        if (!(high > -1.0f && low < float(g.size[a]))) return out;
        near.first[a] = std::max<std::int32_t>(floor_int(low), 0);
        near.size[a] = std::min<std::int32_t>(floor_int(high) + 2, g.size[a]) - near.first[a];
    }
    return near;
}

std::uint64_t most_near_nodes(const NodeGrid& g) {
    const float widest = widest_spacing(g);
    std::uint64_t most = 1;
    for (int a = 0; a < 3; ++a) {
        const float wide = 2.0f * float(kNearReach) * widest * g.per_metre[a];
        most *= std::uint64_t(std::min(double(g.size[a]), double(wide) + 3.0));
    }
    return most;
}

}  // namespace pileus
