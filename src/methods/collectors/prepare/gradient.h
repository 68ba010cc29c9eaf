// SPDX-License-Identifier: Apache-2.0
// Where the density changes: the weight by which samples are drawn.
// in: densities at voxel centres -> out: one weight >= 0 per voxel, its maximum and sum.
// Elek 2011, section 5.1, with the difference quotient (h(x+e) - h(x-e)) / 2e.
#pragma once
#include "src/base/span.h"
#include "src/base/status.h"
#include "src/plan/array.h"
#include "src/world/grid/grid.h"

namespace pileus {

struct FieldStats {
    float max = 0;          ///< largest weight
    double sum = 0;         ///< of all weights, added in a fixed order
    float density_max = 0;  ///< largest density
};

constexpr int kMaxVarianceRadius = 8;

/// Sums of a voxel's neighbours: of their levels of density, and of the squares of these.
struct VarianceSums {
    std::int64_t first, second;
};

namespace arrays {

/// The weight of every voxel, by gradient or by variance.
inline Array<float> gradient_field(const Grid& grid) {
    return {"gradient field", voxel_count(grid), Stage::kSamples, Stage::kSamples};
}
/// What lies beyond the box.
inline Array<float> empty_row(const Grid& grid) {
    return {"empty row", std::uint64_t(grid.size[0]), Stage::kSamples, Stage::kSamples};
}
inline Array<FieldStats> slice_stats(const Grid& grid) {
    return {"statistics of the sampled field", std::uint64_t(grid.size[2]), Stage::kSamples,
            Stage::kSamples};
}
/// Sums per voxel, and per thread those of a slice and of a row.
inline Array<VarianceSums> variance_sums(const Grid& grid) {
    return {"sums of the variance", voxel_count(grid), Stage::kSamples, Stage::kSamples};
}
inline Array<VarianceSums> variance_slices(const Grid& grid, std::uint64_t threads) {
    const std::uint64_t slice = std::uint64_t(grid.size[0]) * std::uint64_t(grid.size[1]);
    return {"sums of the variance", slice * threads, Stage::kSamples, Stage::kSamples};
}
inline Array<VarianceSums> variance_rows(const Grid& grid, std::uint64_t threads) {
    return {"sums of the variance", std::uint64_t(grid.size[0]) * threads, Stage::kSamples,
            Stage::kSamples};
}

}  // namespace arrays

/// |grad rho| at each voxel's centre by central differences over one voxel, 1/m; the density
/// outside the box is zero. `field` holds one float per voxel. kLimit: out of memory.
Status gradient_magnitude(Span<const float> density, const Grid& grid, int threads,
                          Span<float> field, FieldStats& stats);

/// Variance of the voxel densities in the cube of (2 radius + 1)^3 voxels around each voxel, zero
/// outside the box; radius 1..8. Densities are rounded to 2^-18 of the largest and summed as
/// integers, so nothing cancels and a uniform interior gives exactly 0. kLimit: out of memory.
Status local_variance(Span<const float> density, const Grid& grid, int radius, int threads,
                      Span<float> field, FieldStats& stats);

}  // namespace pileus
