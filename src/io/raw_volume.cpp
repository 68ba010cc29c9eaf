// SPDX-License-Identifier: Apache-2.0
// Reads a density grid stored as bare numbers.
// in: uint8, uint16 or float32 values, x fastest -> out: floats, whole numbers scaled to 0..1.
// docs/formats.md
#include "src/base/file.h"
#include "src/io/volume_file.h"

namespace pileus {

namespace {

constexpr std::size_t kPieceValues = 1 << 16;

std::size_t bytes_per_value(RawType type) {
    return type == RawType::kUint8 ? 1 : type == RawType::kUint16 ? 2 : 4;
}

/// Assembles one value from its bytes, whatever this machine's own byte order.
float decode(const unsigned char* at, RawType type, bool big_endian) {
    if (type == RawType::kUint8) return float(at[0]) / 255.0f;
    if (type == RawType::kUint16) {
        const int value = big_endian ? at[0] << 8 | at[1] : at[1] << 8 | at[0];
        return float(value) / 65535.0f;
    }
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits = bits << 8 | at[big_endian ? i : 3 - i];
    float value;
    std::memcpy(&value, &bits, 4);
    return value;
}

/// True for a finite value >= 0; refuses NaN as well.
bool usable(float value) { return value >= 0.0f && value <= 3.402823466e38f; }

}  // namespace

Status read_raw_volume(const std::string& path, RawType type, const std::array<int, 3>& size,
                       bool big_endian, Volume& volume) {
    PILEUS_TRY(check_volume_size(path, {size[0], size[1], size[2]}));
    InputFile file;
    PILEUS_TRY(open_file(path, file));

    // Compare lengths before any memory is taken.
    const std::size_t step = bytes_per_value(type);
    const std::uint64_t count =
        std::uint64_t(size[0]) * std::uint64_t(size[1]) * std::uint64_t(size[2]);
    if (file.size() != count * step)
        return Status::bad_input(path + ": file length: does not fit the size, " +
                                 std::to_string(file.size()) + " bytes, allowed: exactly " +
                                 std::to_string(count * step));
    PILEUS_TRY(volume.density.resize(count, path.c_str()));
    Buffer<unsigned char> piece;
    PILEUS_TRY(piece.resize(kPieceValues * step, path.c_str()));
    volume.size = size;
    volume.knows_bounds = false;
    volume.bounds_m = {};

    // Convert piece by piece, so that the file is never held whole beside the grid.
    for (std::uint64_t done = 0; done < count;) {
        const std::uint64_t left = count - done;
        const std::size_t n = std::size_t(left < kPieceValues ? left : kPieceValues);
        const FileResult result = file.read(piece.data(), n * step);
        if (!result) return read_fault(path, result);
        for (std::size_t i = 0; i < n; ++i, ++done) {
            const float value = decode(piece.data() + i * step, type, big_endian);
            if (!usable(value))
                return Status::bad_input(path + ": density: " + voxel_name(size, done) + ", " +
                                         std::to_string(value) + ", allowed: a finite number >= 0");
            volume.density[std::size_t(done)] = value;
        }
    }
    return Status::ok();
}

}  // namespace pileus
