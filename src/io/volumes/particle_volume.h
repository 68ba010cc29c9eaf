// SPDX-License-Identifier: Apache-2.0
// Particles on a grid, and a grid as particles.
// in: a file of particles, or a Volume -> out: a Volume of extinction, or a file of particles.
// docs/particles.md, "On a grid".
#pragma once
#include "src/io/particles/placed_particles.h"
#include "src/io/volumes/volume.h"

namespace pileus {

/// Cells along each axis where a scene leaves them out: about two to a mean radius, at most `most`.
std::array<int, 3> particle_cells(const ParticleSet& set, int most = 256);

/// Extinction, 1/m, of placed particles on cells of their box: each keeps its integral to rounding,
/// and neither their order nor a thread counts. kLimit: out of memory.
Status grid_particles(const ParticleSet& set, const std::array<int, 3>& size, int threads,
                      Volume& volume);

/// A particle for each cell that is not empty, in the order of cells; each holds what its cell
/// does: radius 1.5 times the cell's mean edge. kBadInput: a volume that does not know its place.
Status particles_of_grid(const std::string& name, const Volume& volume, ParticleSet& set);

/// A file, or what stands in its place, as `medium` says. Errors: those of read_placed_particles;
/// kLimit: cells.
Status read_particle_volume(const MediumSettings& medium, const std::string& path, int threads,
                            const MediumValues& given, Volume& volume);
Status read_particle_head(const MediumSettings& medium, const std::string& path,
                          const MediumValues& given, VolumeHead& head);
Status write_particle_volume(const MediumSettings& medium, const std::string& path,
                             const Volume& volume);

}  // namespace pileus
