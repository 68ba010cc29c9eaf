// SPDX-License-Identifier: Apache-2.0
// Collector colours spread onto a coarse grid, for the marched display.
// in: collectors and their colours -> out: [node][channel], smooth, defined wherever medium is.
// docs/methods.md 3, repair 4: each collector covers a ball, weights normalised.
#pragma once
#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/methods/collectors/prepare/prepared.h"
#include "src/picture/nodes/node_grid.h"
#include "src/plan/array.h"

namespace pileus {

/// Nodes of the grid and of all coarser levels that `splat_colours` keeps behind it.
std::uint64_t source_nodes(const NodeGrid& g);

namespace arrays {

/// So many numbers for each of source_nodes().
inline Array<float> source_grid(std::uint64_t numbers, std::uint64_t nodes, Stage last) {
    return {"source grid", bytes_of(numbers, nodes), Stage::kSplat, last};
}
/// Those over the nodes around a camera, moved.
inline Array<Collector> near_collectors(std::uint64_t collectors) {
    return {"near collectors", collectors, Stage::kSplat, Stage::kSplat};
}
inline Array<float> splat_colours(std::uint64_t numbers, std::uint64_t collectors) {
    return {"colours side by side", bytes_of(numbers, collectors), Stage::kSplat, Stage::kSplat};
}
/// Channels one after the other, for marches of more than a picture's colours.
inline Array<float> source_planes(std::uint64_t channels, std::uint64_t nodes) {
    return {"source planes", bytes_of(channels, nodes), Stage::kSplat, Stage::kDisplay};
}

}  // namespace arrays

struct SplatOptions {
    float radius_factor = 1.2f;  ///< ball over the collector's radius
    float prior_mass = 0;        ///< m^3 of medium, the weight of what lies around; see below
    bool periodic = false;       ///< balls reach over the faces across x and y to the far side
    /// Where medium is, so that no other nodes of the finest level are made: they hold sums that
    /// nobody may read. Without a density all nodes are made.
    MediumView medium{};
    const float* beside = nullptr;     ///< one more number of each node, kept after its channels
    bool guided = false;               ///< see guided_grid.h
    const float* sun_depth = nullptr;  ///< where guided: the sun's optical depth of each node
    float sun_fades = 0;               ///< by e^-(so much of it) guides
    int bounded = 0;                   ///< channels, the first three or none, that are no less
    float least[3] = {};               ///< than this
};

/// Lengths along each axis are counted times this, so that flat cells count as cubes and a ball
/// of a flat deck is as flat as its leaves; 1 where nodes are about as far apart along all axes.
struct SplatMetric {
    float axis[3] = {1, 1, 1};
    float radius = 1;  ///< of a ball of the same volume
};
SplatMetric splat_metric(const NodeGrid& nodes);

/// Of the ball that a collector covers among these nodes, m by splat_metric(): `factor` times its
/// own radius, at least 1.2 spacings of the widest axis.
float ball_radius(const Collector& collector, const NodeGrid& nodes, float factor);

/// Weighted mean per node over the collectors whose ball (radius_factor times the collector's
/// radius, at least 1.2 node spacings) holds it; weight = mass times (1 - d^2/R^2)^2. A node whose
/// weights hold less than `prior_mass` leans on the mean of its surroundings, on coarser and
/// coarser levels (push-pull, Gortler et al. 1996): a collector that a handful of photons met
/// cannot glow on its own, and nodes that no ball holds are defined. `source` gets the finest
/// level first, [node][channels + 1], the last number `beside` or 0; coarser levels follow it. On a
/// periodic grid these wrap around too, exactly where the number of nodes is a power of two. What
/// `source` held is overwritten. kLimit: out of memory.
Status splat_colours(Span<const Collector> collectors, Span<const float> colour, int channels,
                     const NodeGrid& nodes, const SplatOptions& options, int threads,
                     Buffer<float>& source);

/// The finest level of such numbers as [channel][node]. kLimit: out of memory.
Status planes_of_nodes(Span<const float> source, int channels, const NodeGrid& nodes, int threads,
                       Buffer<float>& planes);

}  // namespace pileus
