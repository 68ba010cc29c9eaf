// SPDX-License-Identifier: Apache-2.0
// Scattered light on nodes, filtered: what few photons brought leans on a fit of its surroundings.
// in: sums of the collectors' colours and weights per node -> out: means without most of the noise.
// docs/collectors.md, "The filter of nodes".
#pragma once
#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/methods/collectors/photons/source_grid.h"

namespace pileus {

namespace arrays {

/// Two guides of each node.
inline Array<float> node_guides(std::uint64_t nodes) {
    return {"guides of nodes", bytes_of(2, nodes), Stage::kSplat, Stage::kSplat};
}
/// Sums and fits of all coarser levels, of so many numbers a node with the weight.
inline Array<float> guided_sums(std::uint64_t own, std::uint64_t coarser_nodes) {
    return {"fits of nodes", bytes_of(3 * own + 4, coarser_nodes), Stage::kSplat, Stage::kSplat};
}

}  // namespace arrays

/// The finest level of `source` holds sums of colours by weight, and the weight. They become means
/// that lean, where they hold less than 64 times options.prior_mass, on the coarser level's fit: a
/// mean and its slopes over two guides, e^-(fades depth) of the sun and how much medium is around,
/// both without noise. Slopes lean on those of coarser levels by 4 times that mass. All of it is
/// linear in the colours, but for what ends at `least` in the first `bounded` channels, so that
/// batches of photons may be filtered alike. Sums are taken within both `touched` and `read`, means
/// made within `read`. The two mean masses were chosen on three views (docs/collectors.md).
Status guide_nodes(const NodeGrid& nodes, const SplatOptions& options, int channels,
                   const std::vector<NodeRange>& touched, const std::vector<NodeRange>& read,
                   int threads, Buffer<float>& source);

}  // namespace pileus
