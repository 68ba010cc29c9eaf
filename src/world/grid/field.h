// SPDX-License-Identifier: Apache-2.0
// The density between grid points and its exact integrals, its one meaning in the preparation.
// in: densities at voxel centres -> out: density at a point, mass of each voxel.
// docs/methods.md 1; linear between centres and clamped inside the box, or constant within voxels
// (Grid::constant); zero outside.
#pragma once
#include "src/base/span.h"
#include "src/world/grid/grid.h"

namespace pileus {

/// Density at a point inside the box, given in voxel coordinates [0, size].
float density_at(Span<const float> density, const Grid& grid, const float x[3]);

/// Integral of the density over voxels [range[0], range[1]) of row (j, k), m^3 each.
void mass_row(Span<const float> density, const Grid& grid, const int (&range)[2], int j, int k,
              double* out);

/// The same of every voxel, into `masses` (one per voxel). Exact but for double rounding; the same
/// for any number of threads.
void voxel_masses(Span<const float> density, const Grid& grid, int threads, Span<double> masses);

}  // namespace pileus
