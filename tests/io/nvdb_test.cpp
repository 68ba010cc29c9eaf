// SPDX-License-Identifier: Apache-2.0
// NanoVDB files without the library: what is read, and every fault's line.
// in: small files made here -> out: pass or fail.
// docs/testing.md, label io
#include <doctest/doctest.h>

#include "src/io/volumes/volume_file.h"
#include "tests/io/nvdb_bytes.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using namespace pileus::test;

TEST_CASE("NanoVDB: leaves, tiles and places of four kinds of grids") {
    for (const std::uint32_t type : {kFloat, kDouble, kFp8, kFpN}) {
        INFO("type ", type);
        for (const std::string& bytes : {plain(type), zipped(type)}) {
            if (bytes.empty()) continue;
            Volume v;
            const Status status = decode(bytes, v);
            INFO(status.message);
            REQUIRE(status);
            REQUIRE(v.size == std::array<int, 3>{24, 8, 8});
            CHECK(v.bounds_m[0] == Double3{-0.25, 9, -2});
            CHECK(v.bounds_m[1] == Double3{11.75, 25, 30});
            long wrong = 0;
            for (unsigned z = 0; z < 8; ++z)
                for (unsigned y = 0; y < 8; ++y)
                    for (unsigned x = 0; x < 24; ++x) {
                        const bool alone = x == 9 && y == 2 && z == 3;
                        const float wanted = x >= 16 ? 0.5f
                                             : alone ? voxel(64 + 16 + 3)
                                             : x < 8 ? voxel(x * 64 + y * 8 + z)
                                                     : 0.0f;
                        wrong += v.density[(z * 8 + y) * 24 + x] != wanted;
                    }
            CHECK(wrong == 0);
        }
    }
    VolumeHead head;
    const std::string bytes = plain(kFpN);
    REQUIRE(decode_nvdb_head("a.nvdb", {bytes.data(), bytes.size()}, kName, VdbLimits(), head));
    CHECK(head.kind == "NanoVDB fog volume");
    CHECK(head.detail == "grid \"density\" of \"density\" (fpn); not packed; 1025 active voxels");
}

TEST_CASE("NanoVDB: files, segments, versions and dispatch") {
    const test::TempFolder folder;
    const std::string grid = make_grid(kFloat), one = plain(kFloat);
    std::string two = one + make_file(grid, grid.size(), kFloat, 0, "b_smoke");
    Volume v;
    CHECK(decode({two.data(), two.size()}, "b_smoke", v));
    CHECK(holds(decode({two.data(), two.size()}, "c", v).message,
                "grid: unknown, \"c\", allowed: \"density\" (float), \"b_smoke\" (float)"));
    put(two, 52, 1, 4);
    const Status second = decode(two, v);
    INFO(second.message);
    CHECK(second);
    CHECK(holds(decode({two.data(), two.size()}, kName, v).message, "a level set holds distances"));

    // From 32.6 on files and grids may have marks of their own.
    std::string later = one;
    put(later, 7, '2', 1);
    put(later, 8, 32u << 21 | 9u << 10, 4);
    put(later, kListBytes + 7, '1', 1);
    put(later, kListBytes + 16, 32u << 21 | 9u << 10, 4);
    CHECK(decode(later, v));

    folder.put("a.nvdb", one);
    MediumSettings medium;
    REQUIRE(read_volume(medium, folder.path("a.nvdb"), v));
    CHECK(v.size == std::array<int, 3>{24, 8, 8});
    VolumeHead head;
    REQUIRE(read_volume_head(medium, folder.path("a.nvdb"), head));
    CHECK(head.bounds_m == v.bounds_m);
    medium.source.format = "nanovdb";
    medium.source.grid = "smoke";
    CHECK(holds(read_volume(medium, folder.path("a.nvdb"), v).message, "unknown, \"smoke\""));
    CHECK(read_nvdb_volume(folder.path("none.nvdb"), "", v).code == Code::kBadInput);
}

TEST_CASE("NanoVDB: each fault has its line") {
    const Places p(kFloat);
    constexpr std::size_t g = kListBytes;
    struct Row {
        std::size_t at;
        std::uint64_t value;
        unsigned count;
        const char* line;
    };
    const Row rows[] = {
        {0, 7, 1, "a.nvdb: byte 8: mark of NanoVDB: not there"},
        {7, '1', 1, "mark of NanoVDB: not there"},
        {8, 31u << 21 | 4u << 10, 4, "version: 31.4, allowed: 32.3 to 32.9"},
        {8, 32u << 21 | 2u << 10, 4, "version: 32.2"},
        {8, 32u << 21 | 10u << 10, 4, "version: 32.10"},
        {12, 0, 2, "number of grids: 0, allowed: 1 and more"},
        {12, 5000, 2, "number of grids: 5000"},
        {14, 3, 2, "packing: unknown, 3, allowed: 0 none, 1 zip, 2 blosc"},
        {16, p.end - 32, 8, "allowed: exactly"},
        {24, std::uint64_t(-1), 8, "grid: ends too early"},
        {24, p.end - 1, 8, "mark of NanoVDB: ends too early, 1 bytes left"},
        {48, 6, 4, "grid: none of floats, allowed: \"density\" (vec3f)"},
        {48, 99, 4, "grid: none of floats, allowed: \"density\" (type 99)"},
        {48, 2, 4, "head of a grid: differs from the file's list"},
        {52, 0, 4, "head of a grid: differs from the file's list"},
        {52, 1, 4, "grid \"density\": a level set holds distances"},
        {152, 0, 4, "length of a name: 0, allowed: 1 to 4096"},
        {152, 4097, 4, "length of a name: 4097"},
        {199, 'x', 1, "name of a grid: does not end"},
        {g, 7, 1, "a.nvdb: grid \"density\": byte 8: mark of NanoVDB: not there"},
        {g + 16, 0, 4, "version: 0.0"},
        {g + 32, 5, 8, "head of a grid: differs from the file's list"},
        {g + 392, 0x3ff0000000000000, 8, "transform: rotated or sheared"},
        {g + 384, 0, 8, "scale: out of range, 0,"},
        {g + 528, 0x7ff8000000000000, 8, "translation: out of range, nan"},
        {g + p.tree + 24, 63, 8, "root: at byte 735, allowed: multiples of 32"},
        {g + p.tree + 24, 0, 8, "root: at byte 672"},
        {g + p.tree + 24, std::uint64_t(-32), 8, "root: at byte 640"},
        {g + p.tree + 24, p.end - 672, 8, "root: at byte"},
        {g + p.tree + 32, 1, 4, "leaf: more than the tree states, allowed: 1"},
        {g + p.tree + 32, 3, 4, "nodes of the tree: 2 of kind leaf, allowed: as it states, 3"},
        {g + p.tree + 36, 0, 4, "lower node: more than the tree states"},
        {g + p.tree + 40, 2, 4, "nodes of the tree: 1 of kind upper node"},
        {g + p.root + 28, 0x3f800000, 4, "background: 1.000000, allowed: 0"},
        {g + p.root + 24, 0xffffffff, 4, "tiles of the root: at byte 800"},
        {g + p.tiles + 32, std::uint64_t{0xfffff} << 42 | 1, 8, "a place comes twice"},
        {g + p.tiles, std::uint64_t{1} << 63, 8, "tile of the root: its key is none"},
        {g + p.tiles, 0x1fffff, 8, "tile of the root: its key is none"},
        {g + p.tiles + 8, 1, 8, "upper node: at byte 737, allowed: multiples of 32"},
        {g + p.tiles + 8, p.lower - p.root, 8, "upper node: at byte"},
        {g + p.upper_table(), std::uint64_t(-864), 8, "lower node: at byte 0, allowed"},
        {g + p.lower_table(), p.end - 32 - p.lower, 8, "leaf: at byte"},
        {g + p.lower_table(), 0x7fffffffffffffe0, 8, "leaf: at byte"},
        {g + p.lower_table() + 8 * 512, 0xbf800000, 4, "voxel -4080 0 4096: -1, allowed"},
        {g + p.leaf + 96 + 4 * 73, 0x7fc00000, 4, "voxel -4095 1 4097: nan, allowed"},
        {g + p.leaf + 96 + 4 * 511, 0xbf800000, 4, "voxel -4089 7 4103: -1, allowed"},
    };
    const std::string good = plain(kFloat);
    Volume volume;
    for (const Row& row : rows) {
        std::string bytes = good;
        put(bytes, row.at, row.value, row.count);
        const Status status = decode(bytes, volume);
        INFO(row.line);
        INFO(status.message);
        CHECK(status.code == Code::kBadInput);
        CHECK(holds(status.message, row.line));
    }
    std::string wide = plain(kFpN);
    put(wide, g + Places(kFpN).leaf + 15, 5 << 5, 1);
    CHECK(holds(decode(wide, volume).message, "leaf: 2^5 bits a voxel, allowed: 1 to 16"));
    CHECK(holds(decode({good.data(), good.size()}, "x", volume).message, "grid: unknown, \"x\""));
    std::string vectors = good;
    put(vectors, 48, 6, 4);
    CHECK(holds(decode({vectors.data(), vectors.size()}, kName, volume).message,
                "grid \"density\": type vec3f, allowed: float, double"));
}
