// SPDX-License-Identifier: Apache-2.0
// Reads Mitsuba's grid volumes, trusting nothing in them.
// in: "VOL", byte 3, whole numbers and floats, little-endian -> out: a Volume in file order.
// docs/formats.md

#include "src/base/file.h"
#include "src/io/volumes/volume_file.h"

namespace pileus {

namespace {

constexpr std::size_t kHeaderBytes = 48;

/// Four bytes, lowest first, whatever this machine's own order.
std::uint32_t word_at(Span<const char> bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
    return word;
}

float float_at(Span<const char> bytes, std::size_t at) {
    const std::uint32_t word = word_at(bytes, at);
    float value;
    std::memcpy(&value, &word, 4);
    return value;
}

std::int32_t integer_at(Span<const char> bytes, std::size_t at) {
    return static_cast<std::int32_t>(word_at(bytes, at));
}

Status expect(const std::string& name, const char* key, std::int64_t value, std::int64_t allowed,
              const char* meaning) {
    if (value == allowed) return Status::ok();
    return Status::bad_input(name + ": " + key + ": not supported, " + std::to_string(value) +
                             ", allowed: " + std::to_string(allowed) + " (" + meaning + ")");
}

Status set_box(const std::string& name, Span<const char> header, VolumeHead& head) {
    for (std::size_t i = 0; i < 6; ++i) {
        const double value = double(float_at(header, 24 + 4 * i));
        if (!(value >= -1e9 && value <= 1e9))
            return Status::bad_input(name + ": box: out of range, " + std::to_string(value) +
                                     ", allowed: -1e9 to 1e9");
        head.bounds_m[i / 3][i % 3] = value;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!(head.bounds_m[0][axis] < head.bounds_m[1][axis]))
            return Status::bad_input(name + ": box: upper corner not above the lower on axis " +
                                     std::to_string(axis) +
                                     ", allowed: lower < upper on every axis");
    head.knows_bounds = true;
    return Status::ok();
}

/// Checks the header's 48 bytes, and the file's length against what they state.
Status decode_header(const std::string& name, Span<const char> header, std::uint64_t file_bytes,
                     VolumeHead& head) {
    head = VolumeHead();
    if (header.size < 4 || std::memcmp(header.data, "VOL", 3) != 0)
        return Status::bad_input(name + ": first bytes: not those of a grid volume, allowed: VOL");
    PILEUS_TRY(expect(name, "version", header[3], 3, "the binary form"));
    if (header.size < kHeaderBytes)
        return Status::bad_input(name + ": header: cut short, " + std::to_string(header.size) +
                                 " bytes, allowed: at least " + std::to_string(kHeaderBytes));
    PILEUS_TRY(expect(name, "type", integer_at(header, 4), 1, "float32"));
    const std::array<std::int64_t, 3> size{integer_at(header, 8), integer_at(header, 12),
                                           integer_at(header, 16)};
    PILEUS_TRY(check_volume_size(name, size));
    PILEUS_TRY(expect(name, "channels", integer_at(header, 20), 1, "a density"));
    PILEUS_TRY(set_box(name, header, head));

    // The side lengths are in range, so their product fits.
    const std::uint64_t wanted = kHeaderBytes + 4 * std::uint64_t(size[0] * size[1] * size[2]);
    if (file_bytes != wanted)
        return Status::bad_input(name + ": file length: does not fit the size, " +
                                 std::to_string(file_bytes) + " bytes, allowed: exactly " +
                                 std::to_string(wanted));
    for (std::size_t i = 0; i < 3; ++i) head.size[i] = int(size[i]);
    head.kind = "Mitsuba grid volume";
    return Status::ok();
}

}  // namespace

Status decode_vol_volume(const std::string& name, Span<const char> bytes, Volume& volume) {
    VolumeHead head;
    PILEUS_TRY(decode_header(name, bytes, bytes.size, head));
    const Span<const char> values{bytes.data + kHeaderBytes, bytes.size - kHeaderBytes};
    PILEUS_TRY(decode_raw_volume(name, values, RawType::kFloat32, head.size, false, volume));
    volume.knows_bounds = head.knows_bounds;
    volume.bounds_m = head.bounds_m;
    return Status::ok();
}

Status read_vol_volume(const std::string& path, Volume& volume) {
    // Look at the header first, so that a long file of another kind is not read.
    VolumeHead head;
    PILEUS_TRY(read_vol_head(path, head));
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kHeaderBytes + 4 * kMaxVolumeCells, bytes));
    return decode_vol_volume(path, bytes.span(), volume);
}

Status read_vol_head(const std::string& path, VolumeHead& head) {
    InputFile file;
    PILEUS_TRY(open_file(path, file));
    Buffer<char> header;
    PILEUS_TRY(read_file_start(path, kHeaderBytes, header));
    return decode_header(path, header.span(), file.size(), head);
}

}  // namespace pileus
