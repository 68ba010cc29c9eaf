// SPDX-License-Identifier: Apache-2.0
// Coarser grids of a density, for steps and pixels that its cells are too fine for.
// in: a density grid -> out: levels of half the cells along each axis, with blocks to skip.
// docs/raymarch.md, "Level of detail"; Palenik 2016, 3.4.
#pragma once
#include <vector>

#include "src/run/context.h"
#include "src/world/majorant/majorants.h"

namespace pileus {

/// One level: means of 2 x 2 x 2 cells of the finer one, or of those that there are at its end.
struct DensityLevel {
    Grid grid;
    Buffer<float> density, majorants;
};

/// Grids of `levels` levels above `grid`; fewer where a single cell is left, or where a periodic
/// grid has an odd number of cells, which would not meet itself.
std::vector<Grid> level_grids(const Grid& grid, int levels);

namespace arrays {

/// Of one level; `last` marches.
inline Array<float> coarse_density(const Grid& level, Stage last) {
    return {"coarser density", voxel_count(level), Stage::kMajorants, last};
}
inline Array<float> coarse_blocks(const Grid& level, Stage last) {
    return renamed(block_maxima(level, kSkipBlock), "its blocks", Stage::kMajorants, last);
}

}  // namespace arrays

/// Makes them. kLimit: out of memory.
Status make_density_levels(const Medium& medium, int levels, int block, const Context& context,
                           std::vector<DensityLevel>& out);

}  // namespace pileus
