// SPDX-License-Identifier: Apache-2.0
// Memory of discrete ordinates, as plans list it.
// in: a medium, nodes over it or what is known before -> out: rows of the plan.
// docs/report.md, "Plan"
#pragma once
#include "src/picture/ordinates/sky_ordinates.h"
#include "src/plan/memory_table.h"
#include "src/plan/report.h"

namespace pileus {

struct OrdinateSizes {
    std::uint64_t nodes = 0, filled = 0, rim = 0, samples = 0;
    std::uint64_t all_samples = 0;                ///< of empty nodes, too; of nodes in a box
    bool rays = true;                             ///< depths to the sun are found by rays
    std::uint64_t larger = 0, larger_filled = 0;  ///< of nodes of twice the size
    std::uint64_t levels = 1;                     ///< of a sky in place, each with so many nodes
    std::uint64_t ring = 0;                       ///< nodes around one
    std::uint64_t sets = 0;                       ///< of light
    bool moments = true;                          ///< nodes are read near the camera
    int media = 1, channels = 1;
    bool sunlit = true;
    int beams = 0;        ///< sets whose sunlight stays
    bool own = false;     ///< light of lamps and of media
    bool points = false;  ///< tables for lamps that have a place
    bool solids = false;
    std::uint64_t ways = 0, beside = 0;  ///< that solids end, and nodes with such; of larger nodes
    std::uint64_t larger_ways = 0, larger_beside = 0;
    bool together = false;     ///< sets are shown together
    std::uint64_t ground = 0;  ///< cells of the map of light on it
};

/// Those of nodes, or where there are none yet the most that any phase function brings.
OrdinateSizes ordinate_sizes(const Medium& medium, const OrdinateNodes& made);

/// The same with sets and the ground of a light; they are shown together.
OrdinateSizes lit_ordinate_sizes(const Medium& medium, const Lighting& lighting,
                                 const Solids& solids, const OrdinateNodes& made);

/// Those of a sky in place.
OrdinateSizes sky_level_sizes(const Medium& medium, const SkyOrdinateSizes& sky);

void add_ordinate_rows(const OrdinateSizes& sizes, MemoryTable& table);

/// Whether a camera is so deep among nodes of more than one optical depth that what little light
/// comes there is beyond the bounds of docs/ordinates.md.
bool is_deep(const OrdinateNodes& nodes, const CameraParams& camera);

/// Adds nodes to the report, with the iterations and the last change of the worst solution.
void tell_ordinates(const OrdinateNodes& nodes, Report& report);

}  // namespace pileus
