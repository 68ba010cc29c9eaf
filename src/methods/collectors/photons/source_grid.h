// SPDX-License-Identifier: Apache-2.0
// Collector colours spread onto a coarse grid, for the marched display.
// in: collectors and their colours -> out: [channel][node], smooth, defined wherever medium is.
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
inline Array<float> source_grid(std::uint64_t numbers, std::uint64_t nodes) {
    return {"source grid", bytes_of(numbers, nodes), Stage::kSplat, Stage::kDisplay};
}
inline Array<float> source_weights(std::uint64_t nodes) {
    return {"source weights", nodes, Stage::kSplat, Stage::kSplat};
}

}  // namespace arrays

struct SplatOptions {
    float radius_factor = 1.2f;  ///< ball over the collector's radius
    float prior_mass = 0;        ///< m^3 of medium, the weight of what lies around; see below
    bool periodic = false;       ///< balls reach over the faces across x and y to the far side
    /// Where medium is, so that no other nodes of the finest level are made: they hold sums that
    /// nobody may read. Without a density all nodes are made.
    MediumView medium{};
};

/// Weighted mean per node over the collectors whose ball (radius_factor times the collector's
/// radius, at least 1.2 node spacings) holds it; weight = mass times (1 - d^2/R^2)^2. A node whose
/// weights hold less than `prior_mass` leans on the mean of its surroundings, on coarser and
/// coarser levels (push-pull, Gortler et al. 1996): a collector that a handful of photons met
/// cannot glow on its own, and nodes that no ball holds are defined. `source` gets the finest
/// level first, [channel][node]; coarser levels follow it. On a periodic grid these wrap around
/// too, exactly where the number of nodes is a power of two. kLimit: out of memory.
Status splat_colours(Span<const Collector> collectors, Span<const float> colour, int channels,
                     const NodeGrid& nodes, const SplatOptions& options, int threads,
                     Buffer<float>& source);

}  // namespace pileus
