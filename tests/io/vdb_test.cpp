// SPDX-License-Identifier: Apache-2.0
// OpenVDB files without the library: round trips, every fault's line, damage of every kind.
// in: small files made here -> out: pass or fail.
// docs/testing.md, label io
#include <doctest/doctest.h>

#include <algorithm>

#include "src/io/volumes/vdb/vdb_file.h"
#include "src/io/volumes/volume_file.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using test::holds;

namespace {

Volume make_volume(std::array<int, 3> size, bool full) {
    Volume v;
    v.size = size;
    REQUIRE(v.density.resize(std::uint64_t(size[0]) * unsigned(size[1]) * unsigned(size[2]), "v"));
    for (std::size_t i = 0; i < v.density.size(); ++i)
        v.density[i] = full || i * 2654435761u % 7 < 2 ? float(i % 251 + 1) / 251.0f : 0.0f;
    v.knows_bounds = true;
    v.bounds_m = {{{-3, 10, 1000}, {-3 + 0.25 * size[0], 10 + 0.5 * size[1], 1000.0 + size[2]}}};
    return v;
}

std::string encoded(const Volume& volume, bool zip) {
    Buffer<char> bytes;
    REQUIRE(encode_vdb(volume, zip, bytes));
    return {bytes.data(), bytes.size()};
}

Status decode(const std::string& bytes, Volume& volume, const VdbLimits& limits = VdbLimits()) {
    return decode_vdb("a.vdb", {bytes.data(), bytes.size()}, "", limits, volume);
}

void put(std::string& bytes, std::size_t at, std::uint64_t value, unsigned count) {
    for (unsigned i = 0; i < count; ++i) bytes[at + i] = char(value >> (8 * i) & 255);
}

/// Where `word` ends; the file holds it.
std::size_t behind(const std::string& bytes, const std::string& word) {
    const std::size_t at = bytes.find(word);
    REQUIRE(at != std::string::npos);
    return at + word.size();
}

/// Decodes damaged bytes: whatever comes out is a Status with a line, or a usable volume.
void check_damaged(const std::string& bytes, const VdbLimits& limits, long& read) {
    Volume volume;
    const Status status = decode(bytes, volume, limits);
    VolumeHead head;
    const Status head_status =
        decode_vdb_head("a.vdb", {bytes.data(), bytes.size()}, "", limits, head);
    if (!status) {
        const bool line =
            holds(status.message, "a.vdb") && status.message.find('\n') == std::string::npos;
        const bool code = status.code == Code::kBadInput || status.code == Code::kLimit;
        if (!line || !code) FAIL_CHECK(status.message);
        return;
    }
    ++read;
    bool usable =
        bool(head_status) && head.size == volume.size && volume.density.size() <= limits.max_cells;
    for (const float value : volume.density.span()) usable = usable && value >= 0;
    if (!usable) FAIL_CHECK("not usable, and no fault");
}

// As much as the small files here could honestly fill, so that 10^4 of them take seconds.
constexpr VdbLimits kSmall{std::uint64_t{1} << 16, std::uint64_t{1} << 14, 1};

}  // namespace

TEST_CASE("OpenVDB: what is written is read, cropped to what is not 0") {
    for (const bool zip : {false, true})
        for (const std::array<int, 3> size :
             {std::array<int, 3>{1, 1, 1}, {9, 17, 8}, {130, 3, 5}}) {
            const Volume v = make_volume(size, true);
            const std::string bytes = encoded(v, zip);
            CHECK(bytes == encoded(v, zip));
            Volume again;
            const Status status = decode(bytes, again);
            INFO(status.message);
            REQUIRE(status);
            CHECK(again.size == size);
            CHECK(std::equal(v.density.span().begin(), v.density.span().end(),
                             again.density.span().begin()));
            CHECK(again.knows_bounds);
            // The box goes through centre and cell size: a few roundings of doubles.
            for (std::size_t i = 0; i < 6; ++i)
                CHECK(std::abs(again.bounds_m[i / 3][i % 3] - v.bounds_m[i / 3][i % 3]) <= 1e-12);
        }

    // Zeros around the cloud are not active: the box shrinks, the voxels stay where they are.
    Volume v = make_volume({10, 10, 10}, false);
    std::fill(v.density.span().begin(), v.density.span().end(), 0.0f);
    v.density[(3 * 10 + 4) * 10 + 5] = 0.5f;
    v.density[(6 * 10 + 4) * 10 + 7] = 0.25f;
    Volume again;
    REQUIRE(decode(encoded(v, false), again));
    CHECK(again.size == std::array<int, 3>{3, 1, 4});
    CHECK(again.density[0] == 0.5f);
    CHECK(again.density[11] == 0.25f);
    CHECK(again.bounds_m[0] == Double3{-3 + 5 * 0.25, 10 + 4 * 0.5, 1003});
    CHECK(again.bounds_m[1] == Double3{-3 + 8 * 0.25, 10 + 5 * 0.5, 1007});
    VolumeHead head;
    std::string bytes = encoded(v, false);
    REQUIRE(decode_vdb_head("a.vdb", {bytes.data(), bytes.size()}, "density", VdbLimits(), head));
    CHECK(head.kind == "OpenVDB fog volume");
    CHECK(head.detail ==
          "grid \"density\" of \"density\" (float); not packed, active values; 2 active voxels");
    put(bytes, 8, 222, 4);
    CHECK(decode(bytes, again));
    v.knows_bounds = false;
    REQUIRE(decode(encoded(v, false), again));
    CHECK(again.bounds_m[0] == Double3{5, 4, 3});
}

TEST_CASE("OpenVDB: files, dispatch and raw files out") {
    const test::TempFolder folder;
    const Volume v = make_volume({5, 4, 3}, true);
    REQUIRE(write_vdb_volume(folder.path("new/v.vdb"), v));
    Volume again;
    MediumSettings medium;
    REQUIRE(read_volume(medium, folder.path("new/v.vdb"), again));
    CHECK(again.size == v.size);
    VolumeHead head;
    REQUIRE(read_volume_head(medium, folder.path("new/v.vdb"), head));
    CHECK(head.size == v.size);
    medium.source.format = "openvdb";
    medium.source.grid = "smoke";
    CHECK(holds(read_volume(medium, folder.path("new/v.vdb"), again).message,
                "grid: unknown, \"smoke\", allowed: \"density\" (float)"));
    CHECK(read_vdb_volume(folder.path("none.vdb"), "", again).code == Code::kBadInput);
    CHECK(write_vdb_volume("/dev/null/v.vdb", v).code == Code::kIo);

    // float32 keeps every bit; whole numbers err by half a code at the most, of the scaled range.
    Volume bright = make_volume({5, 4, 3}, true);
    bright.density[7] = 3.0f;
    for (const RawType type : {RawType::kFloat32, RawType::kUint16, RawType::kUint8})
        for (const bool big : {false, true}) {
            const std::string path = folder.path("v.raw");
            REQUIRE(write_raw_volume(path, type, big, bright));
            REQUIRE(read_raw_volume(path, type, bright.size, big, again));
            const double scale = raw_scale(bright, type);
            CHECK(scale == (type == RawType::kFloat32 ? 1.0 : 3.0));
            const double near = type == RawType::kFloat32  ? 0
                                : type == RawType::kUint16 ? scale * 0.51 / 65535
                                                           : scale * 0.51 / 255;
            double worst = 0;
            for (std::size_t i = 0; i < again.density.size(); ++i)
                worst = std::max(
                    worst, std::abs(double(again.density[i]) * scale - double(bright.density[i])));
            CHECK(worst <= near);
        }
}

TEST_CASE("OpenVDB: each fault has its line") {
    const std::string good = encoded(make_volume({9, 9, 9}, true), false);
    const std::size_t offsets = behind(good, "Tree_float_5_4_3") + 4, grid = offsets + 24;
    const std::size_t map = behind(good, "ScaleTranslateMap"), tree = map + 18 * 8;
    const std::size_t root = tree + 16, top = root + 12, low = top + 2 * 4096 + 1;
    struct Row {
        std::size_t at;
        std::uint64_t value;
        unsigned count;
        const char* line;
    };
    const Row rows[] = {
        {0, 7, 1, "a.vdb: byte 8: mark of an OpenVDB file: not there"},
        {8, 221, 4, "format version: 221, allowed: 222 to 224"},
        {20, 0, 1, "mark of offsets: 0, allowed: 1"},
        {61, 5000, 4, "number of grids: too many, 5000"},
        {offsets, 0, 8, "offset of a grid: bytes 0 to"},
        {offsets + 16, 1u << 30, 8, "offset of a grid: bytes"},
        {offsets + 16, 200, 8, "ends too early"},
        {grid, 8, 4, "compression: unknown flags, 8"},
        {grid + 8, 0xffffffff, 4, "name of metadata: too long"},
        {grid + 4, 0xffffffff, 4, "metadata: ends too early"},
        {map + 24, 0, 8, "scale: out of range, 0, allowed: 1e-9 to 1e9, either way"},
        {map + 24, 0x7ff8000000000000, 8, "scale: out of range, nan"},
        {map, 0x7ff8000000000000, 8, "translation: out of range, nan"},
        {tree, 2, 4, "buffers of the tree: 2"},
        {tree + 4, 0x3f800000, 4, "background: 1.000000, allowed: 0"},
        {tree + 8, 0xffffffff, 4, "tile of the root: out of order or twice"},
        {tree + 12, 2, 4, "child of the root: "},
        {root, 8, 4, "child of the root: origin 8, allowed: multiples of 4096"},
        {top + 4096, 1, 1, "mask of tiles: a tile stands where a child is"},
        {top + 2 * 4096, 7, 1, "flag of a node: 7, allowed: 0 to 6"},
        {low + 1024 + 1, 0, 1, "mask of a leaf: differs from the tree's"},
        {good.size() - 4, 0x7fc00000, 4, "voxel 8 8 8: nan, allowed: a finite number >= 0"},
        {good.size() - 4, 0xbf800000, 4, "voxel 8 8 8: -1, allowed"},
    };
    for (const Row& row : rows) {
        std::string bytes = good;
        put(bytes, row.at, row.value, row.count);
        Volume volume;
        const Status status = decode(bytes, volume);
        INFO(status.message);
        CHECK(status.code == Code::kBadInput);
        CHECK(holds(status.message, row.line));
    }
    Volume volume;
    std::string level = good;
    level.replace(good.find("fog volume"), 10, "level set!");
    put(level, level.find("level set!") - 4, 9, 4);
    level.erase(level.find("level set!") + 9, 1);
    put(level, offsets + 16, level.size(), 8);
    CHECK(holds(decode(level, volume).message, "a level set holds distances"));
}

TEST_CASE("OpenVDB: few bytes cannot ask for much memory") {
    // Two far voxels make a large box; the file's length bounds what is taken for it.
    Volume v = make_volume({400, 400, 400}, false);
    std::fill(v.density.span().begin(), v.density.span().end(), 0.0f);
    v.density[0] = v.density[v.density.size() - 1] = 1;
    const std::string bytes = encoded(v, false);
    Volume volume;
    const Status status = decode(bytes, volume);
    CHECK(status.code == Code::kLimit);
    CHECK(holds(status.message, "too many voxels, 64000000, allowed: at most"));
    CHECK(volume.density.empty());
    VdbLimits wide;
    wide.cells_per_byte = 1 << 20;
    CHECK(decode(bytes, volume, wide));
}

TEST_CASE("OpenVDB: cut short anywhere, it is a fault") {
    for (const bool zip : {false, true}) {
        const std::string good = encoded(make_volume({9, 4, 3}, false), zip);
        long read = 0;
        for (std::size_t length = 0; length < good.size(); ++length)
            check_damaged(good.substr(0, length), kSmall, read);
        CHECK(read == 0);
    }
}

TEST_CASE("OpenVDB: damaged at random, it ends with a fault or a usable volume") {
    std::uint64_t state = 7;
    const auto below = [&](std::size_t n) {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        return std::size_t((state >> 33) % n);
    };
    long read = 0, tries = 0;
    for (const bool zip : {false, true}) {
        const std::string good = encoded(make_volume({20, 9, 9}, false), zip);
        // Masks of nodes are mostly empty: spend half of the damage on what stands around them.
        const std::size_t head = behind(good, "ScaleTranslateMap") + 18 * 8 + 28;
        for (int i = 0; i < 3000; ++i, ++tries) {
            std::string bytes = good;
            for (std::size_t n = 1 + below(4); n > 0; --n) {
                const std::size_t at = below(2) == 0 ? below(head) : below(bytes.size());
                bytes[at] = char(below(3) == 0 ? 255 * below(2) : below(256));
            }
            if (below(8) == 0) bytes.resize(below(bytes.size()));
            check_damaged(bytes, kSmall, read);
        }
    }
    MESSAGE(read, " of ", tries, " damaged files still hold a usable volume");
    CHECK(read < tries);
}
