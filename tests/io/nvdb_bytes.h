// SPDX-License-Identifier: Apache-2.0
// Small NanoVDB files made byte by byte, as the tests of their reader need them.
// in: a type of grid -> out: bytes, and the places in them that a test may change.
// docs/testing.md, label io
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "src/io/volumes/vdb/vdb_file.h"
#include "src/io/volumes/vdb/vdb_values.h"

namespace pileus {
namespace test {

inline void put(std::string& bytes, std::size_t at, std::uint64_t value, unsigned count) {
    for (unsigned i = 0; i < count; ++i) bytes[at + i] = char(value >> (8 * i) & 255);
}
inline void put_f32(std::string& bytes, std::size_t at, float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, 4);
    put(bytes, at, bits, 4);
}
inline void put_f64(std::string& bytes, std::size_t at, double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, 8);
    put(bytes, at, bits, 8);
}

constexpr std::uint32_t kVersion = 32u << 21 | 4u << 10, kFloat = 1, kDouble = 2, kFp8 = 14,
                        kFpN = 16;
constexpr std::uint64_t kMagic = 0x304244566f6e614e;
constexpr std::size_t kUpperBytes = 270400, kLowerBytes = 33856, kListBytes = 16 + 176 + 8;
constexpr const char* kName = "density";

/// Places in a grid of floats or doubles with one upper and one lower node, and two leaves.
struct Places {
    explicit Places(std::uint32_t type) {
        const bool wide = type == kDouble;
        tiles = root + (wide ? 96 : 64);
        tile_value = wide ? 24 : 20;
        upper = tiles + 64;
        lower = upper + kUpperBytes;
        leaf = lower + kLowerBytes;
        leaf_values = wide ? 128 : 96;
        leaf_bytes = leaf_values + (wide ? 4096 : type == kFloat ? 2048 : 512);
        end = leaf + 2 * leaf_bytes;
    }
    std::size_t tree = 672, root = 736, tiles, tile_value, upper, lower, leaf, leaf_values,
                leaf_bytes, end;
    std::size_t upper_table() const { return upper + 8256; }
    std::size_t lower_table() const { return lower + 1088; }
};

inline void put_number(std::string& bytes, std::size_t at, std::uint32_t type, float value) {
    if (type == kDouble)
        put_f64(bytes, at, double(value));
    else
        put_f32(bytes, at, value);
}

/// Voxel n of the first leaf; codes of 8 bits can say it exactly.
inline float voxel(unsigned n) { return float(n % 256) * 0.25f + 1.0f; }

inline void put_leaf(std::string& bytes, std::size_t at, const Places& p, std::uint32_t type) {
    for (unsigned n = 0; n < 512; ++n) {
        const std::size_t values = at + p.leaf_values;
        if (type == kFloat || type == kDouble)
            put_number(bytes, values + n * (type == kDouble ? 8 : 4), type, voxel(n));
        else
            put(bytes, values + n, n % 256, 1);
    }
    if (type == kFloat || type == kDouble) return;
    put_f32(bytes, at + 80, 1.0f);
    put_f32(bytes, at + 84, 0.25f);
    if (type == kFpN) put(bytes, at + 15, 3 << 5, 1);
}

/// A full leaf at 0 0 0, one voxel 1 2 3 of the leaf at 8 0 0, and a tile of 0.5 at 16 0 0, all
/// counted from -4096 0 4096.
inline std::string make_grid(std::uint32_t type) {
    const Places p(type);
    std::string g(p.end, '\0');
    put(g, 0, kMagic, 8);
    put(g, 16, kVersion, 4);
    put(g, 32, p.end, 8);
    g.replace(40, 7, kName);
    const double scale[3] = {0.5, 2, 4}, shift[3] = {2048, 10, -16384};
    for (unsigned a = 0; a < 3; ++a) {
        put_f64(g, 384 + 32 * a, scale[a]);
        put_f64(g, 528 + 8 * a, shift[a]);
    }
    put(g, 632, 2, 4);
    put(g, 636, type, 4);
    const std::size_t nodes[4] = {p.leaf, p.lower, p.upper, p.root};
    for (unsigned i = 0; i < 4; ++i) put(g, p.tree + 8 * i, nodes[i] - p.tree, 8);
    put(g, p.tree + 32, 2, 4);
    put(g, p.tree + 36, 1, 4);
    put(g, p.tree + 40, 1, 4);

    // The root: a child, and an inactive tile whose number does not count.
    put(g, p.root + 24, 2, 4);
    const std::uint64_t key = std::uint64_t{0xfffff} << 42 | 1;
    put(g, p.tiles, key, 8);
    put(g, p.tiles + 8, p.upper - p.root, 8);
    put(g, p.tiles + 32, 5, 8);
    put_number(g, p.tiles + 32 + p.tile_value, type, -7.0f);

    // Children: bit 0 of the upper node; bits 0 and 256 of the lower one, and its tile 512.
    g[p.upper + 32 + 4096] = 1;
    put(g, p.upper_table(), p.lower - p.upper, 8);
    g[p.lower + 32 + 512] = g[p.lower + 32 + 512 + 32] = 1;
    put(g, p.lower_table(), p.leaf - p.lower, 8);
    put(g, p.lower_table() + 8 * 256, p.leaf + p.leaf_bytes - p.lower, 8);
    g[p.lower + 32 + 64] = 1;
    put_number(g, p.lower_table() + 8 * 512, type, 0.5f);
    put_number(g, p.lower_table() + 8 * 513, type, -9.0f);
    std::fill_n(g.begin() + std::ptrdiff_t(p.leaf) + 16, 64, char(255));
    put(g, p.leaf + p.leaf_bytes + 16 + 8 + 2, 1 << 3, 1);
    put_leaf(g, p.leaf, p, type);
    put_leaf(g, p.leaf + p.leaf_bytes, p, type);
    return g;
}

/// One segment with one grid; `packed` are its bytes in the file.
inline std::string make_file(const std::string& packed, std::size_t size, std::uint32_t type,
                             unsigned codec, const char* name = kName) {
    std::string head(kListBytes, '\0');
    put(head, 0, kMagic, 8);
    put(head, 8, kVersion, 4);
    put(head, 12, 1, 2);
    put(head, 14, codec, 2);
    put(head, 16, size, 8);
    put(head, 24, packed.size(), 8);
    put(head, 48, type, 4);
    put(head, 52, 2, 4);
    put(head, 152, 8, 4);
    head.replace(192, 7, name);
    return head + packed;
}

inline std::string plain(std::uint32_t type) {
    const std::string grid = make_grid(type);
    return make_file(grid, grid.size(), type, 0);
}

/// The same by zlib; empty where the build has none.
inline std::string zipped(std::uint32_t type) {
    const std::string grid = make_grid(type);
    std::string room(grid.size() + 8, '\0');
    const std::uint64_t count =
        deflate_block(reinterpret_cast<const unsigned char*>(grid.data()), grid.size(),
                      reinterpret_cast<unsigned char*>(&room[8]), grid.size());
    if (count == 0) return {};
    put(room, 0, count, 8);
    room.resize(8 + std::size_t(count));
    return make_file(room, grid.size(), type, 1);
}

inline Status decode(Span<const char> bytes, const char* grid, Volume& volume,
                     const VdbLimits& limits = VdbLimits()) {
    return decode_nvdb("a.nvdb", bytes, grid, limits, volume);
}
inline Status decode(const std::string& bytes, Volume& volume) {
    return decode({bytes.data(), bytes.size()}, "", volume);
}

}  // namespace test
}  // namespace pileus
