// SPDX-License-Identifier: Apache-2.0
// Maximum and sum of a weight per voxel, added in an order that no thread count changes.
// in: densities and weights -> out: FieldStats.
// docs/architecture.md, determinism.
#pragma once
#include "src/methods/collectors/prepare/gradient.h"

namespace pileus {

/// Rows that are added up side by side.
constexpr int kAbreast = 4;

/// Sums of `rows` rows (1..kAbreast) of `count` numbers, `stride` apart, each from its first number
/// to its last: side by side none waits for its own last addition.
void sums_abreast(const float* values, std::size_t count, std::size_t stride, int rows,
                  double* sums);

/// Fills `stats`. kLimit: out of memory.
Status field_stats(Span<const float> density, Span<const float> field, const Grid& grid,
                   int threads, FieldStats& stats);

}  // namespace pileus
