// SPDX-License-Identifier: Apache-2.0
// Finer cells for light that is kept in them: the same density on a grid of an odd number of cells
// for each.
// in: a medium on its data's cells -> out: its grid and densities on finer ones.
// docs/methods.md 2, "Cells for light".
#pragma once
#include <array>

#include "src/world/medium/medium.h"
#include "src/world/medium/resample.h"

namespace pileus {

/// Cells of each axis that take the place of one: odd. All 1 where the medium's own are no deeper
/// than one optical depth and at least four along axes that are not thin, or are as many as a finer
/// grid may have. A cell that is wider than a flat box is thick stays: light knows no more of it
/// than its height.
std::array<int, 3> finer_cells(const Medium& medium, const Limits& limits);

/// Gives a medium a grid of so many cells for each of its own; its values stay as they are.
inline void refine_grid(const std::array<int, 3>& factor, Medium& medium) {
    std::array<int, 3> size = medium.volume.size;
    for (std::size_t a = 0; a < 3; ++a) size[a] = medium.grid.size[a] * factor[a];
    medium.grid = resampled_grid(medium, size);
    medium.volume.size = size;
}

/// Gives the medium that grid; densities follow where it has any. Exact: between centres a density
/// is linear, and of an odd number of cells the middle one keeps the centre. kLimit: memory.
Status refine_medium(const std::array<int, 3>& factor, int threads, Medium& medium);

/// What the plan says of it.
std::string told_finer_cells(const Medium& medium, const std::array<int, 3>& factor);

}  // namespace pileus
