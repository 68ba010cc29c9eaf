// SPDX-License-Identifier: Apache-2.0
// Majorants for cells that gather light at every tentative collision: floored where medium is near.
// in: a medium, a regular grid of cells over its box -> out: majorants, which cells are reached.
// docs/photon-grid.md, "Deposits": a floor of 1 / (cell size) bounds what one collision stands for.
#pragma once
#include "src/world/majorant/majorants.h"

namespace pileus {

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
