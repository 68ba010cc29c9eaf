// SPDX-License-Identifier: Apache-2.0
// See particle_file.h.
#include "src/io/particles/particle_file.h"

#include "src/base/file.h"
#include "src/io/text/text_scan.h"

namespace pileus {

Status decode_particles(const std::string& name, const std::string& extension,
                        Span<const char> bytes, const ParticleReading& reading, ParticleSet& set) {
    if (extension == ".prt") return decode_particle_prt(name, bytes, reading, set);
    return extension == ".csv" ? decode_particle_csv(name, bytes, reading, set)
                               : decode_particle_ply(name, bytes, reading, set);
}

Status read_particles(const std::string& path, const std::string& extension,
                      const ParticleReading& reading, ParticleSet& set) {
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kMaxTextBytes, bytes));
    return decode_particles(path, extension, bytes.span(), reading, set);
}

}  // namespace pileus
