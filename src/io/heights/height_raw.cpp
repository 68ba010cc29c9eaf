// SPDX-License-Identifier: Apache-2.0
// Maps of heights as bare numbers: of any size, and the square tiles of the SRTM mission.
// in: int16, uint16 or float32 from the north-west, row by row -> out: samples; voids as NaN.
// docs/solids.md, "Height maps"; USGS, "SRTM topography": .hgt is int16, big-endian, void -32768.
#include <cstring>
#include <limits>

#include "src/io/heights/height_map.h"

namespace pileus {
namespace {

constexpr float kHole = std::numeric_limits<float>::quiet_NaN();

std::size_t bytes_of_type(HeightType type) { return type == HeightType::kFloat32 ? 4 : 2; }

/// Assembles one value from its bytes, whatever this machine's own byte order.
float value_of_bytes(const unsigned char* at, HeightType type, bool big_endian) {
    std::uint32_t bits = 0;
    const int count = int(bytes_of_type(type));
    for (int i = 0; i < count; ++i) bits = bits << 8 | at[big_endian ? i : count - 1 - i];
    if (type == HeightType::kUint16) return float(bits);
    if (type == HeightType::kInt16) {
        const int value = int(bits) - (bits >= 0x8000u ? 0x10000 : 0);
        return value == -32768 ? kHole : float(value);
    }
    float value;
    std::memcpy(&value, &bits, 4);
    return value;
}

void take_values(Span<const char> bytes, HeightType type, bool big_endian, HeightGrid& grid) {
    const auto* from = reinterpret_cast<const unsigned char*>(bytes.data);
    const std::size_t step = bytes_of_type(type);
    for (std::size_t i = 0; i < grid.height.size(); ++i)
        grid.height[i] = value_of_bytes(from + i * step, type, big_endian);
}

}  // namespace

Status decode_raw_heights(const std::string& name, Span<const char> bytes,
                          const HeightMapSettings& settings, std::uint64_t max_triangles,
                          HeightGrid& grid) {
    const std::int64_t columns = settings.raw_size[0], rows = settings.raw_size[1];
    // Compare lengths before any memory is taken.
    const std::uint64_t wanted =
        columns < 0 || rows < 0
            ? 0
            : std::uint64_t(columns) * std::uint64_t(rows) * bytes_of_type(settings.raw_type);
    if (bytes.size != wanted)
        return Status::bad_input(name + ": file length: does not fit raw_size, " +
                                 std::to_string(bytes.size) + " bytes, allowed: exactly " +
                                 std::to_string(wanted));
    PILEUS_TRY(size_heights(name, columns, rows, settings, max_triangles, grid));
    if (settings.raw_type == HeightType::kUint16) grid.full_scale = 65535;
    take_values(bytes, settings.raw_type, settings.raw_big_endian, grid);
    return Status::ok();
}

Status decode_hgt_heights(const std::string& name, Span<const char> bytes,
                          const HeightMapSettings& settings, std::uint64_t max_triangles,
                          HeightGrid& grid) {
    std::int64_t side = 2;
    while (side < kMaxHeightSide && std::uint64_t(2 * side * side) < bytes.size) ++side;
    if (std::uint64_t(2 * side * side) != bytes.size)
        return Status::bad_input(name + ": file length: no square of samples, " +
                                 std::to_string(bytes.size) +
                                 " bytes, allowed: 2 n n, such as 2884802 for 1201 x 1201");
    PILEUS_TRY(size_heights(name, side, side, settings, max_triangles, grid));
    take_values(bytes, HeightType::kInt16, true, grid);
    return Status::ok();
}

}  // namespace pileus
