// SPDX-License-Identifier: Apache-2.0
// Iterations of discrete ordinates, mixed so that thick media need few.
// in: nodes, light that enters, the beam -> out: moments of the radiance.
// docs/ordinates.md, "Iterations"; Anderson 1965.
#pragma once
#include "src/picture/ordinates/ordinates.h"

namespace pileus {

/// Memory that solutions share, one after the other.
struct OrdinateSolver {
    Buffer<float> work;
    Buffer<float> parts;  ///< [medium][node]: of the extinction that counts; of several alone
    Buffer<float> slices;
    Buffer<std::int32_t> place_x;  ///< of nodes that hold medium, where slices are along x
    int channel = -1;              ///< whose ways through nodes the work holds
    bool left = false;             ///< the work holds what leaves nodes, of empty ones, too
};

/// Light that begins in nodes; null: none.
struct OrdinateSources {
    const float* beam = nullptr;     ///< [filled]: of the sun, of an irradiance of 1
    const float* fixed = nullptr;    ///< [direction][filled]
    const float* ring = nullptr;     ///< [direction][node of the ring]: what enters there
    bool started = false;            ///< the moments are a start
    OrdinateWalls* walls = nullptr;  ///< of the nodes; null: no solid ends a way
    std::size_t set = 0;             ///< among OrdinateWalls::sends
};

/// Nodes of a ring: calls use(number in the ring, node).
template <class Use>
void each_of_ring(const NodeGrid& grid, const Use& use) {
    const int nx = grid.size[0], ny = grid.size[1];
    std::size_t number = 0;
    for (int z = 0; z < grid.size[2]; ++z)
        for (int y = 0; y < ny; ++y) {
            const bool end = y == 0 || y == ny - 1;
            for (int x = 0; x < nx; x += end || nx == 1 ? 1 : nx - 1)
                use(number++, node_number(grid, {x, y, z}));
        }
}
inline std::uint64_t ring_count(const NodeGrid& grid) {
    std::uint64_t count = 0;
    each_of_ring(grid, [&](std::size_t, std::size_t) { ++count; });
    return count;
}

/// Whether a solution begins, in place of going on from that of another light.
inline bool begins(int iterations, const OrdinateSet& set) {
    return iterations == 0 || !set.solved;
}

/// `iterations`: at most, from set.solved on; 0: all, from none. `moments`: [moment][filled].
/// kLimit: out of memory.
Status solve_ordinates(const Context& context, const Medium& medium, const OrdinateCells& nodes,
                       const Lighting& lighting, const OrdinateSources& from, int iterations,
                       OrdinateSolver& solver, OrdinateSet& set, float* moments);

/// Radiance that leaves nodes downwards, at the end of the way through each.
struct OrdinateLeaving {
    const float* radiance = nullptr;  ///< [direction][place], in the solver's memory
    float length_m[kOrdinates]{};     ///< of the way
    bool along_x[kOrdinates]{};       ///< places are those of slices along x
};

/// A node's place where slices are along x: y fastest, then z.
inline std::size_t place_along_x(const NodeGrid& grid, const NodePlace& p) {
    return (std::size_t(p[0]) * std::size_t(grid.size[2]) + std::size_t(p[2])) *
               std::size_t(grid.size[1]) +
           std::size_t(p[1]);
}

/// Of a solution by these moments. kLimit: out of memory.
Status leave_nodes(const Context& context, const Medium& medium, const OrdinateCells& nodes,
                   const Lighting& lighting, const OrdinateSources& from, OrdinateSolver& solver,
                   const OrdinateSet& set, float* moments, OrdinateLeaving& out);

}  // namespace pileus
