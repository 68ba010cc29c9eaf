// SPDX-License-Identifier: Apache-2.0
// From sums of photons in cells to the light that each cell scatters.
// in: slots of integer sums, which cells are near medium, the camera -> out: radiance per cell.
// docs/methods.md 5; docs/photon-grid.md, "What a cell shows".
#pragma once
#include "src/photons/light_input.h"
#include "src/picture/nodes/node_grid.h"
#include "src/world/majorant/majorants.h"

namespace pileus {

struct GridLightInput : LightInput {
    CellGrid cells;
    Span<const std::uint8_t> marks;
    Span<const float> shares;  ///< [cell][medium]; not read for one medium
    GridClosure closure = GridClosure::kSh;
    double unit_m2 = 1;  ///< what a deposit of 1 stands for: cell volume over the longest track
};

namespace arrays {

/// So many numbers for each cell.
inline Array<float> cell_light(std::uint64_t numbers, std::uint64_t cells) {
    return {"light of the cells", bytes_of(numbers, cells), Stage::kReconstruct, Stage::kDisplay};
}
inline Array<float> cell_shares(std::uint64_t cells, std::uint64_t media) {
    return {"shares of the media", bytes_of(media, cells), Stage::kMajorants, Stage::kWrite};
}

}  // namespace arrays

/// Share of each medium in the extinction of a cell, or of its surroundings where it holds none.
/// kLimit: out of memory.
Status make_cell_shares(const Medium& medium, const CellGrid& cells, Span<const std::uint8_t> marks,
                        int threads, Buffer<float>& shares);

/// Radiance that an optically thick medium would show the camera, scattered light alone:
/// [3 * (1 + batches)][cell]. Nothing is clamped, so that its mean is the light's.
/// kLimit: out of memory.
Status light_cells(const GridLightInput& in, Buffer<float>& out);

/// Sets of harmonics of what leaves cells, and of degrees about the sun's axis, as the march reads
/// them: [part][cell][set][stored harmonics].
struct CellHarmonics {
    int sets = 0;
    float colour[3][3] = {};  ///< [set][channel]
};

/// Which part of such numbers is made, from batch `batch` of the slots, or all: -1.
struct HarmonicPart {
    int batch, part, parts, stored;
};

/// Fills one part, of the cells of `those` alone. Slots shot under another sun are taken to be
/// under this one beyond the bands. Closure kSh. kLimit: out of memory.
Status light_cell_harmonics(const GridLightInput& in, const HarmonicPart& which,
                            const NearNodes& those, CellHarmonics& sets, Buffer<float>& values);

}  // namespace pileus
