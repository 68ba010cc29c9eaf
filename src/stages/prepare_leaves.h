// SPDX-License-Identifier: Apache-2.0
// What each leaf holds, and in which leaf each voxel lies.
// in: leaves as boxes, densities, masses -> out: the leaves' numbers, a leaf index per voxel.
// Elek 2011, section 5.4; docs/methods.md 3, prepare 3-4.
#pragma once
#include "src/base/span.h"
#include "src/stages/prepared.h"

namespace pileus {

/// Fills majorant (density, one-voxel border included), mass (m^3) and filled of every leaf.
/// The masses of all leaves add up to the volume's but for double rounding.
void measure_leaves(Span<const float> density, Span<const double> masses, const Grid& grid,
                    int threads, Span<Leaf> leaves);

/// Writes each voxel's leaf index; the leaves tile the grid.
void fill_leaf_grid(Span<const Leaf> leaves, const Grid& grid, int threads,
                    Span<std::int32_t> leaf_of_voxel);

}  // namespace pileus
