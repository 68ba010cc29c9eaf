// SPDX-License-Identifier: Apache-2.0
// Maximum and sum of a weight per voxel, added in an order that no thread count changes.
// in: densities and weights -> out: FieldStats.
// docs/architecture.md, determinism.
#pragma once
#include "src/stages/prepare_gradient.h"

namespace pileus {

/// Fills `stats`. kLimit: out of memory.
Status field_stats(Span<const float> density, Span<const float> field, const Grid& grid,
                   int threads, FieldStats& stats);

}  // namespace pileus
