// SPDX-License-Identifier: Apache-2.0
// See particle_file.h.
#include "src/io/particles/particle_file.h"

#include "src/base/file.h"
#include "src/base/printable.h"
#include "src/base/reading_limit.h"
#include "src/io/text/packed_bytes.h"
#include "src/io/text/text_scan.h"

namespace pileus {
namespace {

/// What is none of these is PLY.
struct ParticleDecoder {
    const char* extensions;  ///< parted by '|'
    Status (*decode)(const std::string&, Span<const char>, const ParticleReading&, ParticleSet&);
};
constexpr ParticleDecoder kDecoders[] = {
    {"|.csv|", decode_particle_csv},
    {"|.prt|", decode_particle_prt},
    {"|.bgeo|.geo|.bhclassic|.hclassic|", decode_particle_geo},
    {"|.pdb|", decode_particle_pdb},
    {"|.pda|", decode_particle_pda},
};

}  // namespace

Status decode_particles(const std::string& name, const std::string& extension,
                        Span<const char> bytes, const ParticleReading& reading, ParticleSet& set) {
    if (bytes.size >= 2 && bytes.data[0] == '\x1f' && bytes.data[1] == '\x8b') {
        Buffer<char> unpacked;
        PILEUS_TRY(inflate_gzip(name, bytes, reading.most_unpacked, unpacked));
        const Span<const char> inner = unpacked.span();
        const ReadingHold hold(inner.size);
        if (inner.size >= 2 && inner[0] == '\x1f' && inner[1] == '\x8b')
            return ByteCursor(name, inner).fault("gzip: packed twice, allowed: once");
        return decode_particles(name, extension, inner, reading, set);
    }
    for (const ParticleDecoder& row : kDecoders)
        if (std::string(row.extensions).find('|' + extension + '|') != std::string::npos)
            return row.decode(name, without_mark(bytes), reading, set);
    return decode_particle_ply(name, without_mark(bytes), reading, set);
}

Status read_particles(const std::string& path, const std::string& extension,
                      const ParticleReading& reading, ParticleSet& set) {
    InputFile file;
    PILEUS_TRY(open_file(path, file));
    PILEUS_TRY(check_reading(path, file.size()));
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kMaxTextBytes, bytes));
    const ReadingHold hold(bytes.size());
    return decode_particles(path, extension, bytes.span(), reading, set);
}

}  // namespace pileus
