// SPDX-License-Identifier: Apache-2.0
// Where the density changes: the weight by which samples are drawn.
// in: densities at voxel centres -> out: one weight >= 0 per voxel, its maximum and sum.
// Elek 2011, section 5.1, with the difference quotient (h(x+e) - h(x-e)) / 2e.
#pragma once
#include "src/base/span.h"
#include "src/base/status.h"
#include "src/world/grid/grid.h"

namespace pileus {

struct FieldStats {
    float max = 0;          ///< largest weight
    double sum = 0;         ///< of all weights, added in a fixed order
    float density_max = 0;  ///< largest density
};

constexpr int kMaxVarianceRadius = 8;

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
