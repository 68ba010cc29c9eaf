// SPDX-License-Identifier: Apache-2.0
// See shares.h.
// in: leaves, the densities of the parts -> out: mass of a medium in the leaf over the leaf's mass.
// docs/methods.md 1: the mass is the exact integral of the trilinear field, part by part.
#include "src/methods/collectors/prepare/shares.h"

#include "platform/threads.h"
#include "src/world/grid/grid.h"

namespace pileus {
namespace {

double mass_in(const Leaf& leaf, const Grid& grid, Span<const double> masses) {
    double mass = 0;
    for (int k = leaf.lo[2]; k < leaf.hi[2]; ++k)
        for (int j = leaf.lo[1]; j < leaf.hi[1]; ++j) {
            const std::size_t row = voxel_index(grid, 0, j, k);
            for (int i = leaf.lo[0]; i < leaf.hi[0]; ++i) mass += masses[row + std::size_t(i)];
        }
    return mass;
}

}  // namespace

Status measure_shares(const Medium& medium, Span<const Leaf> leaves,
                      Span<const Collector> collectors, int threads, Buffer<float>& shares) {
    const std::size_t voxels = voxel_count(medium.grid), media = std::size_t(medium.count);
    assert(medium.parts.size() == (media - 1) * voxels);
    Buffer<double> masses;
    PILEUS_TRY(allocate(arrays::part_masses(medium.grid), masses));
    PILEUS_TRY(allocate(arrays::shares(collectors.size, media), shares));
    for (std::size_t c = 0; c < collectors.size; ++c) shares[c * media] = 1;
    for (std::size_t i = 1; i < media; ++i) {
        const Span<const float> part{medium.parts.data() + (i - 1) * voxels, voxels};
        voxel_masses(part, medium.grid, threads, masses.span());
        parallel_for(threads, std::int64_t(collectors.size), [&](std::int64_t c, int) {
            const Collector& collector = collectors[std::size_t(c)];
            float* own = shares.data() + std::size_t(c) * media;
            const float share =
                float(mass_in(leaves[std::size_t(collector.leaf)], medium.grid, masses.span()) /
                      collector.mass);
            // What rounding makes of a share must not leave less than nothing for medium 0.
            own[i] = share < own[0] ? share : own[0];
            own[0] -= own[i];
        });
    }
    return Status::ok();
}

}  // namespace pileus
