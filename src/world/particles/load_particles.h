// SPDX-License-Identifier: Apache-2.0
// The particles of a medium, placed in the world.
// in: the scene's words about one medium -> out: particles in metres, z up, densities as
// extinction. docs/particles.md, "Data".
#pragma once
#include "src/base/limits.h"
#include "src/base/status.h"
#include "src/io/particles/particles.h"
#include "src/scene/scene.h"

namespace pileus {

/// Reads or makes the particles of a medium, whose density is a file of particles or a recipe of
/// them (is_particles). In `out` lengths are metres with z up, `origin` is in the world, every
/// particle has a radius, and `density` is its extinction at the centre, 1/m: of particle i at
/// distance r from its centre density[i] (1 - r^2 / radius[i]^2)^2 within the radius, 0 beyond;
/// extinctions of all add up. Errors: those of the readers; kBadInput: no radius in the file and
/// none in the scene; kLimit.
Status load_particles(const Scene& scene, const MediumSettings& settings, const Limits& limits,
                      int threads, ParticleSet& out);

/// Whether a medium is made of particles: a file of them, by format or extension, or a recipe.
bool is_particles(const MediumSettings& settings);

}  // namespace pileus
