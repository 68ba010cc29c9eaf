// SPDX-License-Identifier: Apache-2.0
// All of a scene that no method owns: its media on one grid, its sky map, its solids.
// in: a checked scene -> out: World, from sizes alone or with its values.
// docs/architecture.md, "How a frame is made".
#pragma once
#include "src/io/particles/particles.h"
#include "src/run/context.h"
#include "src/world/atmosphere/atmosphere.h"
#include "src/world/density/sky_field.h"
#include "src/world/light/lights.h"
#include "src/world/light/sky_map.h"
#include "src/world/medium/medium.h"
#include "src/world/solids/camera_depth.h"
#include "src/world/solids/solids.h"

namespace pileus {

/// Made once, then read only and shared; depends on neither camera nor light, and of methods only
/// on what they ask of it, WorldUse.
struct World {
    std::size_t media = 0;  ///< of the scene that it was made of
    Medium medium;          ///< all media on one grid; a voxel of nothing for a scene without any
    MediumSource source;
    Plan media_plan;          ///< what laying the media on one grid says
    bool data_cells = false;  ///< deep cells are left as they are
    bool direct_sky = false;  ///< the medium is `layer`, evaluated in place
    SkyField layer;
    Solids solids;
    bool fine_cells = false;       ///< for light that is kept in them: finer ones than the data's
    bool deep_cells = false;       ///< the data's are too deep for that
    bool refined = false;          ///< the grid's cells are parts of the densities' own
    bool given = false;            ///< a host gave densities of its memory
    Volume unrefined;              ///< those of one medium, where they were refined
    bool shows_particles = false;  ///< its medium's grid is for shadows alone
    ParticleSet particles;         ///< of such a world: metres as the grid's, extinction in 1/m
    std::string density_digest;    ///< made once for runs that share the world; empty: not yet
};

/// What a method asks of its world: every medium on a grid, that in the data's own cells however
/// deep they are, a procedural sky evaluated in place, or particles themselves.
enum class WorldUse { kGrid, kDataCells, kSkyInPlace, kParticles };

/// Whether its media are one of particles.
bool shows_particles(const Scene& scene);

/// What the scene's sizes tell, reading no values of media: limits, places, solids. `given`: media
/// in place of the scene's.
/// Errors: kLimit: a limit; kBadInput, kIo: a file that is missing or wrong.
Status outline_world(const Scene& scene, WorldUse use, const HostMedia& given,
                     const Context& context, World& world);

/// Reads or makes all values of an outlined world. Errors: those of the readers; kLimit: memory.
Status load_world(const Scene& scene, const HostMedia& given, const Context& context, World& world);

/// Bytes of the arrays that sessions share.
std::uint64_t bytes_of_world(const World& world);

/// Digest of every density, and of each medium's part where there are several.
std::string density_digest(const World& world);

}  // namespace pileus
