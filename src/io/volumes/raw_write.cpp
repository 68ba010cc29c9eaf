// SPDX-License-Identifier: Apache-2.0
// Writes a density grid as bare numbers.
// in: a Volume -> out: uint8, uint16 or float32 values, x fastest.
// docs/formats.md
#include "src/base/file.h"
#include "src/io/volumes/volume_file.h"

namespace pileus {

double raw_scale(const Volume& volume, RawType type) {
    if (type == RawType::kFloat32) return 1.0;
    // Extinctions are small numbers: they use the whole range of codes too.
    float most = volume.in_extinction ? 0.0f : 1.0f;
    for (const float value : volume.density.span())
        if (value > most) most = value;
    return most > 0.0f ? double(most) : 1.0;
}

Status write_raw_volume(const std::string& path, RawType type, bool big_endian,
                        const Volume& volume) {
    PILEUS_TRY(can_write_file(path));
    const unsigned step = type == RawType::kUint8 ? 1 : type == RawType::kUint16 ? 2 : 4;
    const double codes = (step == 1 ? 255.0 : 65535.0) / raw_scale(volume, type);
    Buffer<char> bytes;
    PILEUS_TRY(bytes.resize(std::uint64_t(volume.density.size()) * step, path.c_str()));
    for (std::size_t i = 0; i < volume.density.size(); ++i) {
        const float value = volume.density[i];
        std::uint32_t bits = 0;
        if (step == 4)
            std::memcpy(&bits, &value, 4);
        else
            bits = std::uint32_t(double(value) * codes + 0.5);
        for (unsigned b = 0; b < step; ++b)
            bytes[i * step + (big_endian ? step - 1 - b : b)] = char(bits >> (8 * b) & 255);
    }
    return write_file(path, bytes.span());
}

}  // namespace pileus
