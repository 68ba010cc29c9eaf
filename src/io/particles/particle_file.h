// SPDX-License-Identifier: Apache-2.0
// Files of particles: who reads which, and what they hold.
// in: .ply, .csv, .prt, .bgeo, .pdb and .pda files that nobody has checked -> out: a ParticleSet,
// or one line. docs/particles.md, "Data"; docs/formats.md, "Particles".
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "src/base/span.h"
#include "src/base/status.h"
#include "src/io/particles/particles.h"

namespace pileus {

/// Coordinates and radii stay within this, either way.
constexpr double kMaxParticlePlace = 1e12;

/// What a scene says beside the file.
struct ParticleReading {
    std::uint64_t most = 200'000'000;            ///< particles
    std::function<void(double share)> progress;  ///< told now and then how much is read; or empty
    std::uint64_t most_unpacked = std::uint64_t{1} << 34;  ///< bytes of a file packed by gzip
    double radius = 0;  ///< of every particle, in the file's unit; 0: the file's own
};

/// A column of numbers by its name.
struct ParticleColumn {
    std::string name;
    bool byte = false;  ///< whole numbers up to 255, which colours are divided by
};

/// Reads a file; which kind is told by `extension`, such as ".ply". Missing, malformed,
/// numbers out of range, no radius in the file and none in `reading`: kBadInput; too many particles
/// or out of memory: kLimit.
Status read_particles(const std::string& path, const std::string& extension,
                      const ParticleReading& reading, ParticleSet& set);

/// The same from the bytes of a file; packed by gzip they are unpacked.
Status decode_particles(const std::string& name, const std::string& extension,
                        Span<const char> bytes, const ParticleReading& reading, ParticleSet& set);

// One file per format.
Status decode_particle_ply(const std::string& name, Span<const char> bytes,
                           const ParticleReading& reading, ParticleSet& set);
Status decode_particle_prt(const std::string& name, Span<const char> bytes,
                           const ParticleReading& reading, ParticleSet& set);
Status decode_particle_geo(const std::string& name, Span<const char> bytes,
                           const ParticleReading& reading, ParticleSet& set);
Status decode_particle_pdb(const std::string& name, Span<const char> bytes,
                           const ParticleReading& reading, ParticleSet& set);
Status decode_particle_pda(const std::string& name, Span<const char> bytes,
                           const ParticleReading& reading, ParticleSet& set);
Status decode_particle_csv(const std::string& name, Span<const char> bytes,
                           const ParticleReading& reading, ParticleSet& set);

/// Writes x, y, z, radius, density, and colour and id where there are any, as a binary PLY file.
/// Places that floats cannot hold are doubles. kIo: cannot write; kLimit: out of memory.
Status write_particle_ply(const std::string& path, const ParticleSet& set);

}  // namespace pileus
