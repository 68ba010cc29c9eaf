// SPDX-License-Identifier: Apache-2.0
// A coarse grid of nodes over the medium, on which light is kept.
// in: the medium's grid, a spacing -> out: how many nodes along each axis, and where.
// docs/methods.md 3, repair 4.
#pragma once
#include <array>

#include "kernels_cpu/display/march_params.h"
#include "src/world/grid/grid.h"

namespace pileus {

/// Nodes at (i + 1/2) * spacing; per axis the spacing is at least `spacing_m` and at least a voxel.
NodeGrid make_node_grid(const Grid& grid, const double (&extent_m)[3], double spacing_m);

/// The same, but farther apart where there would be more than `budget`; then each axis keeps a node
/// for two optical depths of `extinction_per_m`, 24 at most, so that a flat box keeps layers.
NodeGrid make_layered_grid(const Grid& grid, const double (&extent_m)[3], double extinction_per_m,
                           double spacing_m, double budget);

/// Light falls off within a few optical depths of a face, so a flat box keeps layers of two of them
/// across `depth`, up to `most`: how many, which is below 1 in a thin box.
inline double layers_of_depth(double depth, double most) {
    const double layers = 0.5 * depth;
    return layers < most ? layers : most;
}

/// So many nodes along each axis.
NodeGrid make_sized_grid(const int (&size)[3], const double (&extent_m)[3]);

/// Nodes two voxels apart along each axis, for what changes from voxel to voxel along a way through
/// them, as depths towards the sun do: where voxels are flat, over less than their longest edge.
NodeGrid make_half_grid(const Grid& grid, const double (&extent_m)[3]);

/// Nodes of `g` about a camera within or beside it, and how far from the camera they count. None
/// where no node is so near. Lengths in m, box-local.
NearNodes near_nodes(const NodeGrid& g, const float (&camera)[3]);

/// The largest number of them, wherever the camera is.
std::uint64_t most_near_nodes(const NodeGrid& g);

inline std::uint64_t node_count(const NearNodes& n) {
    return std::uint64_t(n.size[0]) * std::uint64_t(n.size[1]) * std::uint64_t(n.size[2]);
}

/// A node's place along x, y and z by its number, x fastest, then y; and the number by the place.
using NodePlace = std::array<int, 3>;
inline NodePlace node_place(const NodeGrid& g, std::size_t node) {
    const std::size_t nx = std::size_t(g.size[0]), ny = std::size_t(g.size[1]);
    return {int(node % nx), int(node / nx % ny), int(node / (nx * ny))};
}
inline std::size_t node_number(const NodeGrid& g, const NodePlace& p) {
    return (std::size_t(p[2]) * std::size_t(g.size[1]) + std::size_t(p[1])) *
               std::size_t(g.size[0]) +
           std::size_t(p[0]);
}

inline std::uint64_t node_count(const NodeGrid& g) {
    return std::uint64_t(g.size[0]) * std::uint64_t(g.size[1]) * std::uint64_t(g.size[2]);
}

}  // namespace pileus
