// SPDX-License-Identifier: Apache-2.0
// The particles of a medium, in metres.
// in: a file, what the scene says of it -> out: particles whose density is extinction.
// docs/particles.md, "Data", "Replication".
#pragma once
#include <string>

#include "src/base/angles.h"
#include "src/io/particles/particle_file.h"
#include "src/scene/media/host_media.h"
#include "src/scene/scene.h"

namespace pileus {

/// Integral of (1 - r^2)^2 over the ball of radius 1.
constexpr double kBallMass = 32.0 * kPi64 / 105.0;

/// Reads medium.density, or a host's. In `set` lengths are metres along the file's own axes, and
/// `density`, which is never empty, is each particle's extinction at its centre, 1/m: at distance r
/// from it density (1 - r^2 / radius^2)^2 within the radius, 0 beyond, and those of all particles
/// add up. Errors: those of read_particles; kBadInput: an extinction that floats cannot hold.
Status read_placed_particles(const MediumSettings& medium, const std::string& path,
                             ParticleSet& set, const HostParticles* host = nullptr,
                             const std::function<void(double share)>& progress = {});

/// Particles of a host, in its unit; kBadInput names the one that is out of range.
Status read_host_particles(const HostParticles& host, const ParticleReading& reading,
                           ParticleSet& set);

/// The same of particles in the file's unit.
Status place_particles(const std::string& name, const ParticleSettings& settings, ParticleSet& set);

/// Turns particles whose y axis points up, as permute_y_up turns a grid.
void turn_particles_y_up(ParticleSet& set);

}  // namespace pileus
