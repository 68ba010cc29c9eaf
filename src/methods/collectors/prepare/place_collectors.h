// SPDX-License-Identifier: Apache-2.0
// One sphere per leaf that holds medium, with the leaf's optical cross-section.
// in: measured leaves, moments, samples -> out: collectors, and their index in each leaf.
// Elek 2011, section 5.5; docs/methods.md 3, prepare 5 and repair 1.
#pragma once
#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/methods/collectors/prepare/leaves.h"

namespace pileus {

struct CollectorOptions {
    bool paper = false;           ///< centroid of the samples, whole leaf, R = 2r
    float radius_factor = 1.35f;  ///< R/r of the other variant; [1, 3]
};

/// Of the samples in a leaf.
struct SampleCentroid {
    double sum[3], weight;
};

namespace arrays {

inline Array<Collector> collectors(std::uint64_t count) {
    return {"collectors", count, Stage::kCollectors, Stage::kWrite};
}
/// Only for `paper`.
inline Array<SampleCentroid> sample_centroids(std::uint64_t leaves) {
    return {"centroids of samples", leaves, Stage::kLeafGrid, Stage::kLeafGrid};
}

}  // namespace arrays

/// Places a collector in every leaf of positive mass, in the order of the leaves, and sets
/// Leaf::collector. `paper`: centre = centroid of the leaf's samples (the leaf's centre where it
/// has none), r from the leaf's edges, R = 2r. Otherwise: the leaf is cropped to its voxels of
/// positive mass, centre = centroid of their masses, R = radius_factor * r. In both
/// extinction * 4/3 pi R^3 = mass. `moments`: those of measure_leaves. Only `paper` reads samples
/// and leaf_of_voxel, which else may be empty. kLimit: out of memory.
Status place_collectors(const CollectorOptions& options, Span<const LeafMoments> moments,
                        const Grid& grid, Span<const Sample> samples,
                        Span<const std::int32_t> leaf_of_voxel, int threads, Span<Leaf> leaves,
                        Buffer<Collector>& collectors);

}  // namespace pileus
