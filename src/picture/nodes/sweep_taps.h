// SPDX-License-Identifier: Apache-2.0
// Weights of the sweep: which neighbours a node's ray to the next slice runs over, and how far.
// in: a grid, a direction to the sun -> out: constants of a launch, the same for every node.
// docs/buffer.md. On a piece within one cell the trilinear field is a cubic along the ray:
// Simpson's rule is exact, so the weights are too.
#pragma once
#include <array>
#include <vector>

#include "kernels_cpu/light/sweep_params.h"
#include "src/world/grid/grid.h"

namespace pileus {

/// Of an open grid, any direction but 0; blocks for so many threads. `extinction_per_m` at
/// density 1.
SweepParams sweep_params(const Grid& grid, const std::array<float, 3>& to_sun,
                         double extinction_per_m, int threads);

/// A periodic grid: the neighbours of nodes below the top slice, and of those in it. Slices lie
/// along z; false where the sun is so low that a ray runs over more than kMaxShift voxels between
/// two of them.
constexpr double kMaxShift = 256;
bool layer_taps(const Grid& grid, const std::array<float, 3>& to_sun, double extinction_per_m,
                std::vector<SweepTap>& inner, std::vector<SweepTap>& top);

}  // namespace pileus
