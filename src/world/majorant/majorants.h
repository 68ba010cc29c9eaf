// SPDX-License-Identifier: Apache-2.0
// The majorants of a medium: those that free flights track by, and those that marches skip by.
// in: a medium -> out: two coarse grids of largest densities, read only once they are made.
// docs/methods.md 1; majorant.h describes one grid of them.
#pragma once
#include <vector>

#include "kernels_cpu/media/track_grid.h"
#include "src/run/context.h"
#include "src/world/majorant/majorant.h"
#include "src/world/medium/medium.h"

namespace pileus {

struct Majorants {
    Buffer<float> tracking;       ///< per tracking block
    int block = 1;                ///< edge of a tracking block, voxels
    Buffer<float> skipping;       ///< per block of the marching kernels
    int skip_block = kSkipBlock;  ///< its edge, voxels
};

/// Blocks that marches skip by: the largest density of each, and where that is 0, minus the empty
/// blocks on all sides (mark_empty_blocks), unless the grid is periodic. kLimit: out of memory.
Status make_skip_blocks(Span<const float> density, const Grid& grid, int block, int threads,
                        Buffer<float>& skipping);

/// The tracking blocks and the skipping blocks; `costs` of tracking choose the former. Not `local`:
/// one tracking block for the whole grid. kLimit: out of memory.
Status make_majorants(const Medium& medium, bool local, const Context& context, Majorants& out,
                      const TrackingCosts& costs = {});

/// What suits photons: fitted to the times of blocks of 4, 8 and 16 voxels on two clouds
/// (docs/performance.md).
constexpr TrackingCosts kPhotonTracking{1.0, 0.85, 0.15};

/// The same for photons, which leap over empty blocks: with blocks that suit them, and with the
/// empty ones marked (mark_empty_blocks).
Status make_photon_majorants(const Medium& medium, bool local, const Context& context,
                             Majorants& out);

/// What trackers need of a medium. `block` as the majorants were made with.
TrackGrid track_grid(const Medium& medium, Span<const float> majorants, int block,
                     std::uint32_t max_events);

// Coarser grids of a density, for steps and pixels that its cells are too fine for: levels of half
// the cells along each axis, with blocks to skip. docs/raymarch.md, "Level of detail"; Palenik
// 2016, 3.4.

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

// Majorants for cells that gather light at every tentative collision: floored where medium is near.
// A floor of 1 / (cell size) bounds what one collision stands for. docs/photon-grid.md, "Deposits".

/// A regular grid of cells over a medium's box.
struct CellGrid {
    int size[3] = {1, 1, 1};

    std::uint64_t count() const {
        return std::uint64_t(size[0]) * std::uint64_t(size[1]) * std::uint64_t(size[2]);
    }
};

enum CellMark : std::uint8_t { kCellEmpty = 0, kCellHolds = 1, kCellBeside = 2 };

namespace arrays {

inline Array<std::uint8_t> cell_marks(std::uint64_t cells) {
    return {"cells near medium", cells, Stage::kMajorants, Stage::kWrite};
}

}  // namespace arrays

struct CellMajorants {
    Buffer<std::uint8_t> marks;  ///< CellMark of each cell, x fastest
    std::uint64_t marked = 0;    ///< that hold medium or lie beside one that does
    float least_density = 1;     ///< least positive majorant
};

/// As make_photon_majorants, with every block that touches a marked cell raised to the density at
/// which the mean free path is a cell's edge (the cube root of its volume). kLimit: out of memory.
Status make_cell_majorants(const Medium& medium, bool local, const CellGrid& cells,
                           const Context& context, Majorants& out, CellMajorants& near);

}  // namespace pileus
