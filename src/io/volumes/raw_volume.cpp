// SPDX-License-Identifier: Apache-2.0
// Reads a density grid stored as bare numbers.
// in: uint8, uint16 or float32 values, x fastest -> out: floats, whole numbers scaled to 0..1.
// docs/formats.md
#include "src/base/file.h"
#include "src/base/number_text.h"
#include "src/io/volumes/undershoot.h"
#include "src/io/volumes/volume_file.h"

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

/// Not infinite and not NaN.
bool is_finite(float value) { return value - value == 0.0f; }

/// What was met below 0, and where.
struct Negative {
    Undershoot undershoot;
    std::uint64_t lowest = 0;
};

Status voxel_fault(const std::string& name, const Volume& volume, std::uint64_t index,
                   const std::string& text) {
    return Status::bad_input(name + ": density: " + voxel_name(volume.size, index) + ", " + text);
}

/// Checks the stated size, and the length against it.
Status check_length(const std::string& name, RawType type, const std::array<int, 3>& size,
                    std::uint64_t bytes, std::uint64_t& count) {
    PILEUS_TRY(check_volume_size(name, {size[0], size[1], size[2]}));
    count = std::uint64_t(size[0]) * std::uint64_t(size[1]) * std::uint64_t(size[2]);
    const std::uint64_t wanted = count * bytes_per_value(type);
    if (bytes == wanted) return Status::ok();
    return Status::bad_input(name + ": file length: does not fit the size, " +
                             std::to_string(bytes) + " bytes, allowed: exactly " +
                             std::to_string(wanted));
}

/// Converts `count` values from `from` on, the first of which is voxel `first`.
Status decode_values(const std::string& name, const unsigned char* from, RawType type,
                     bool big_endian, std::uint64_t first, std::uint64_t count, Negative& negative,
                     Volume& volume) {
    const std::size_t step = bytes_per_value(type);
    for (std::uint64_t i = 0; i < count; ++i) {
        float value = decode(from + i * step, type, big_endian);
        if (!is_finite(value))
            return voxel_fault(name, volume, first + i,
                               number_text(double(value)) + ", allowed: a finite number >= 0");
        if (negative.undershoot.take(value)) negative.lowest = first + i;
        volume.density.at(std::size_t(first + i)) = value;
    }
    return Status::ok();
}

/// After the last value.
Status finish(const std::string& name, const Negative& negative, Volume& volume) {
    if (negative.undershoot.is_fault())
        return voxel_fault(name, volume, negative.lowest, negative.undershoot.text());
    negative.undershoot.settle(volume);
    return Status::ok();
}

Status make_room(const std::string& name, const std::array<int, 3>& size, std::uint64_t count,
                 Volume& volume) {
    volume.size = size;
    volume.knows_bounds = false;
    volume.bounds_m = {};
    volume.in_extinction = false;
    volume.missing = volume.clamped = 0;
    return volume.density.resize(count, name.c_str());
}

}  // namespace

Status decode_raw_volume(const std::string& name, Span<const char> bytes, RawType type,
                         const std::array<int, 3>& size, bool big_endian, Volume& volume) {
    std::uint64_t count = 0;
    PILEUS_TRY(check_length(name, type, size, bytes.size, count));
    PILEUS_TRY(make_room(name, size, count, volume));
    const auto* from = reinterpret_cast<const unsigned char*>(bytes.data);
    Negative negative;
    PILEUS_TRY(decode_values(name, from, type, big_endian, 0, count, negative, volume));
    return finish(name, negative, volume);
}

Status read_raw_volume(const std::string& path, RawType type, const std::array<int, 3>& size,
                       bool big_endian, Volume& volume) {
    PILEUS_TRY(check_volume_size(path, {size[0], size[1], size[2]}));
    InputFile file;
    PILEUS_TRY(open_file(path, file));

    // Compare lengths before any memory is taken.
    std::uint64_t count = 0;
    PILEUS_TRY(check_length(path, type, size, file.size(), count));
    PILEUS_TRY(make_room(path, size, count, volume));
    const std::size_t step = bytes_per_value(type);
    Buffer<unsigned char> piece;
    PILEUS_TRY(piece.resize(kPieceValues * step, path.c_str()));

    Negative negative;
    // Convert piece by piece, so that the file is never held whole beside the grid.
    for (std::uint64_t done = 0; done < count;) {
        const std::uint64_t left = count - done;
        const std::size_t n = std::size_t(left < kPieceValues ? left : kPieceValues);
        const FileResult result = file.read(piece.data(), n * step);
        if (!result) return read_fault(path, result);
        PILEUS_TRY(decode_values(path, piece.data(), type, big_endian, done, n, negative, volume));
        done += n;
    }
    return finish(path, negative, volume);
}

Status read_raw_head(const std::string& path, RawType type, const std::array<int, 3>& size,
                     VolumeHead& head) {
    static const char* const types[] = {"uint8", "uint16", "float32"};
    PILEUS_TRY(check_volume_size(path, {size[0], size[1], size[2]}));
    InputFile file;
    PILEUS_TRY(open_file(path, file));
    std::uint64_t count = 0;
    PILEUS_TRY(check_length(path, type, size, file.size(), count));
    head = VolumeHead();
    head.size = size;
    head.kind = std::string("raw numbers, ") + types[std::size_t(type)];
    return Status::ok();
}

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
