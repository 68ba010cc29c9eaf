// SPDX-License-Identifier: Apache-2.0
// See place_collectors.h.
// in: measured leaves, moments, samples -> out: collectors, and their index in each leaf.
// Elek 2011, section 5.5; the factor 8 there is the ratio of volumes for R = 2r.
#include "src/methods/collectors/prepare/place_collectors.h"

#include <algorithm>
#include <cstring>

#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/base/powers.h"

namespace pileus {
namespace {

constexpr std::size_t kChunk = 32;

/// Adds up the samples of each leaf in the order of the samples.
void sum_samples(Span<const Sample> samples, const Grid& grid,
                 Span<const std::int32_t> leaf_of_voxel, Span<SampleCentroid> sums) {
    for (const Sample& s : samples) {
        int voxel[3];
        for (int a = 0; a < 3; ++a) voxel[a] = std::min(int(s.x[a]), grid.size[a] - 1);
        const std::size_t v = voxel_index(grid, voxel[0], voxel[1], voxel[2]);
        SampleCentroid& c = sums[std::size_t(leaf_of_voxel[v])];
        for (int a = 0; a < 3; ++a) c.sum[a] += double(s.x[a]);
        c.weight += 1.0;
    }
}

void finish(Collector& c, const Grid& grid, const double centre[3], const double edge[3],
            double factor) {
    double volume = 1.0;
    for (int a = 0; a < 3; ++a) {
        c.centre[a] = float(centre[a] * double(grid.cell_m[a]));
        volume *= edge[a] * double(grid.cell_m[a]);
    }
    const double r = cube_root(volume * 3.0 / (4.0 * kPi64));
    c.radius = float(r);
    c.billboard_radius = float(r * factor);
    // Divide by the volume of the rounded radius, so that rounding does not lose cross-section.
    const double R = double(c.billboard_radius);
    c.extinction = float(c.mass / (4.0 / 3.0 * kPi64 * R * R * R));
}

void place_paper(Collector& c, const Leaf& leaf, const SampleCentroid& samples, const Grid& grid) {
    double centre[3], edge[3];
    for (int a = 0; a < 3; ++a) {
        edge[a] = double(leaf.hi[a] - leaf.lo[a]);
        centre[a] = samples.weight > 0 ? samples.sum[a] / samples.weight
                                       : 0.5 * double(leaf.lo[a] + leaf.hi[a]);
    }
    finish(c, grid, centre, edge, 2.0);
}

void place_best(Collector& c, const Leaf& leaf, const LeafMoments& m, const Grid& grid,
                double factor) {
    double centre[3], edge[3];
    for (int a = 0; a < 3; ++a) {
        centre[a] = double(leaf.lo[a]) + m.first[a] / leaf.mass;
        edge[a] = double(m.hi[a] - m.lo[a]);
    }
    finish(c, grid, centre, edge, factor);
}

}  // namespace

Status place_collectors(const CollectorOptions& options, Span<const LeafMoments> moments,
                        const Grid& grid, Span<const Sample> samples,
                        Span<const std::int32_t> leaf_of_voxel, int threads, Span<Leaf> leaves,
                        Buffer<Collector>& collectors) {
    assert(moments.size == leaves.size);
    assert(!options.paper || leaf_of_voxel.size == voxel_count(grid));
    // Number the leaves that take part.
    std::size_t count = 0;
    for (Leaf& leaf : leaves) leaf.collector = leaf.mass > 0 ? std::int32_t(count++) : -1;
    PILEUS_TRY(allocate(arrays::collectors(count), collectors));
    Buffer<SampleCentroid> sums;
    if (options.paper) {
        PILEUS_TRY(allocate(arrays::sample_centroids(leaves.size), sums));
        sum_samples(samples, grid, leaf_of_voxel, sums.span());
    }
    const std::int64_t pieces = std::int64_t((leaves.size + kChunk - 1) / kChunk);
    parallel_for(threads, pieces, [&](std::int64_t piece, int) {
        const std::size_t begin = std::size_t(piece) * kChunk;
        for (std::size_t l = begin; l < std::min(begin + kChunk, leaves.size); ++l) {
            const Leaf& leaf = leaves[l];
            if (leaf.collector < 0) continue;
            Collector& c = collectors[std::size_t(leaf.collector)];
            c.mass = leaf.mass;
            c.leaf = std::int32_t(l);
            if (options.paper)
                place_paper(c, leaf, sums[l], grid);
            else
                place_best(c, leaf, moments[l], grid, double(options.radius_factor));
        }
    });
    return Status::ok();
}

}  // namespace pileus
