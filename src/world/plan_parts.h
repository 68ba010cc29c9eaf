// SPDX-License-Identifier: Apache-2.0
// What the plans of all methods have in common: memory of density, majorants and picture, work.
// in: sizes, a medium, a plan -> out: rows of the plan's table, its limits, faults.
// docs/report.md, "Plan", "Memory", "Work".
#pragma once
#include <initializer_list>

#include "src/plan/plan.h"
#include "src/run/context.h"
#include "src/world/light/lights.h"
#include "src/world/light/sky_map.h"
#include "src/world/majorant/majorant.h"
#include "src/world/medium/medium.h"

namespace pileus {

/// Most tracking blocks that `prepare_majorants` may choose; one where it is not `local`.
std::uint64_t most_tracking_blocks(const Grid& grid, bool local);

/// Bytes of a scene's sky map and map of the ground, and of their files and pictures while they
/// are read.
struct SkyMapBytes {
    std::uint64_t kept = 0, reading = 0, ground = 0, ground_reading = 0;
};
SkyMapBytes sky_map_bytes(const SkyMap& map, const GroundLook& look);

/// Reading or making the density of so many media on one grid, the bytes of their tables of phase
/// functions, and the sky map.
void add_density_rows(const Grid& grid, const MediumSource& source, std::uint64_t media,
                      std::uint64_t phases, std::uint64_t threads, const SkyMapBytes& sky,
                      MemoryTable& table);

/// The tracking blocks, their search, and the blocks that marching skips; `last` uses them last.
void add_majorant_rows(const Grid& grid, std::uint64_t blocks, std::uint64_t threads, Stage last,
                       MemoryTable& table);

/// An image of so many layers, and its encoding into a file.
void add_image_rows(std::uint64_t width, std::uint64_t height, std::uint64_t layers,
                    MemoryTable& table);

/// What the law of the expected work needs of a medium.
WorkInput medium_work(const Medium& medium, double mean_density, double max_events, double photons);

/// kLimit: more scatterings than the limits allow. `where` opens the line.
Status check_work(const WorkEstimate& work, const Limits& limits, const std::string& where);

/// What laying the media on one grid has told.
void note_media(const Plan& media, Plan& plan);
/// Whether a picture has a test of depths, and distances to the media.
void note_depths(const Lighting& lighting, bool wanted, Plan& plan);
/// What methods that march emission do with it; `photons`: of what is scattered, too.
void note_emission(const Medium& medium, bool photons, Plan& plan);

/// What the scene and the plan, which is complete by now, need of these limits.
void note_limits(const Scene& scene, const Grid& grid, const Limits& limits,
                 std::initializer_list<LimitId> ids, Plan& plan);

/// The largest whole number of 63 bits instead of a larger one.
std::uint64_t whole(double number);

}  // namespace pileus
