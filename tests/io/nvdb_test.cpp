// SPDX-License-Identifier: Apache-2.0
// NanoVDB files without the library: what is read, every fault's line, damage of every kind.
// in: small files made here -> out: pass or fail.
// docs/testing.md, label io
#include <doctest/doctest.h>

#include <algorithm>

#include "src/io/nvdb_file.h"
#include "src/io/vdb_values.h"
#include "src/io/volume_file.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using test::holds;

namespace {

void put(std::string& bytes, std::size_t at, std::uint64_t value, unsigned count) {
    for (unsigned i = 0; i < count; ++i) bytes[at + i] = char(value >> (8 * i) & 255);
}
void put_f32(std::string& bytes, std::size_t at, float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, 4);
    put(bytes, at, bits, 4);
}
void put_f64(std::string& bytes, std::size_t at, double value) {
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

void put_number(std::string& bytes, std::size_t at, std::uint32_t type, float value) {
    if (type == kDouble)
        put_f64(bytes, at, double(value));
    else
        put_f32(bytes, at, value);
}

/// Voxel n of the first leaf; codes of 8 bits can say it exactly.
float voxel(unsigned n) { return float(n % 256) * 0.25f + 1.0f; }

void put_leaf(std::string& bytes, std::size_t at, const Places& p, std::uint32_t type) {
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
std::string make_grid(std::uint32_t type) {
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
std::string make_file(const std::string& packed, std::size_t size, std::uint32_t type,
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

std::string plain(std::uint32_t type) {
    const std::string grid = make_grid(type);
    return make_file(grid, grid.size(), type, 0);
}

/// The same by zlib; empty where the build has none.
std::string zipped(std::uint32_t type) {
    const std::string grid = make_grid(type);
    std::string room(grid.size() + 8, '\0');
    const std::uint64_t count =
        vdb_deflate(reinterpret_cast<const unsigned char*>(grid.data()), grid.size(),
                    reinterpret_cast<unsigned char*>(&room[8]), grid.size());
    if (count == 0) return {};
    put(room, 0, count, 8);
    room.resize(8 + std::size_t(count));
    return make_file(room, grid.size(), type, 1);
}

Status decode(Span<const char> bytes, const char* grid, Volume& volume,
              const VdbLimits& limits = VdbLimits()) {
    return decode_nvdb("a.nvdb", bytes, grid, limits, volume);
}
Status decode(const std::string& bytes, Volume& volume) {
    return decode({bytes.data(), bytes.size()}, "", volume);
}

// As much as the small files here could honestly fill, so that thousands of them take seconds.
constexpr VdbLimits kSmall{std::uint64_t{1} << 16, std::uint64_t{1} << 16, 1};

/// Decodes damaged bytes: whatever comes out is a Status with a line, or a usable volume.
void check_damaged(Span<const char> bytes, long& read) {
    Volume volume;
    VolumeHead head;
    const Status status = decode(bytes, "", volume, kSmall);
    const Status head_status = decode_nvdb_head("a.nvdb", bytes, "", kSmall, head);
    if (!status) {
        const bool line =
            holds(status.message, "a.nvdb") && status.message.find('\n') == std::string::npos;
        const bool code = status.code == Code::kBadInput || status.code == Code::kLimit;
        if (!line || !code) FAIL_CHECK(status.message);
        return;
    }
    ++read;
    bool usable =
        bool(head_status) && head.size == volume.size && volume.density.size() <= kSmall.max_cells;
    for (const float value : volume.density.span()) usable = usable && value >= 0;
    if (!usable) FAIL_CHECK("not usable, and no fault");
}

}  // namespace

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
            CHECK(v.bounds_m[0] == std::array<double, 3>{-0.25, 9, -2});
            CHECK(v.bounds_m[1] == std::array<double, 3>{11.75, 25, 30});
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
    medium.format = "nanovdb";
    medium.grid = "smoke";
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
        {g + 392, 0x3ff0000000000000, 8, "map: rotated or sheared"},
        {g + 384, 0, 8, "scale: out of range, 0.000000"},
        {g + 384, 0xbff0000000000000, 8, "scale: out of range, -1.000000"},
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
        {g + p.lower_table() + 8 * 512, 0xbf800000, 4, "voxel -4080 0 4096: -1.000000"},
        {g + p.leaf + 96 + 4 * 73, 0x7fc00000, 4, "voxel -4095 1 4097: nan, allowed"},
        {g + p.leaf + 96 + 4 * 511, 0xbf800000, 4, "voxel -4089 7 4103: -1.000000"},
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
    std::string empty = good;
    put(empty, g + p.root + 24, 0, 4);
    for (const unsigned at : {32, 36, 40}) put(empty, g + p.tree + at, 0, 4);
    CHECK(holds(decode(empty, volume).message, "no active voxel"));
    std::string vectors = good;
    put(vectors, 48, 6, 4);
    CHECK(holds(decode({vectors.data(), vectors.size()}, kName, volume).message,
                "grid \"density\": type vec3f, allowed: float, double"));
}

TEST_CASE("NanoVDB: packed grids and their faults") {
    const std::string good = zipped(kFloat);
    if (good.empty()) {
        MESSAGE("skipped: zlib is not in this build");
        return;
    }
    Volume volume;
    REQUIRE(decode(good, volume));
    VolumeHead head;
    REQUIRE(decode_nvdb_head("a.nvdb", {good.data(), good.size()}, "", VdbLimits(), head));
    CHECK(head.unpacked_bytes == Places(kFloat).end);
    CHECK(holds(head.detail, "; zip; 1025 active voxels"));
    const auto fault = [&](std::size_t at, std::uint64_t value, unsigned count, const char* line) {
        std::string bytes = good;
        put(bytes, at, value, count);
        const Status status = decode(bytes, volume);
        INFO(status.message);
        CHECK(status.code == Code::kBadInput);
        CHECK(holds(status.message, line));
    };
    const std::size_t packed = good.size() - kListBytes;
    fault(16, Places(kFloat).end + 1, 8, "packed values: damaged, allowed: a block of");
    fault(16, Places(kFloat).end - 1, 8, "packed values: damaged");
    fault(16, packed * 1032 + 1, 8, "allowed: at most");
    fault(16, 0, 8, "too many, allowed: none");
    fault(kListBytes, packed, 8, "packed bytes: ends too early");
    fault(kListBytes + 8, 0, 1, "packed values: damaged");
    fault(14, 2, 2, holds(vdb_library_text(), "blosc yes") ? "packed values: damaged" : "blosc");
    std::string longer = good + std::string(3, '\0');
    put(longer, 24, packed + 3, 8);
    CHECK(holds(decode(longer, volume).message, "packed bytes: 3 too many, allowed: none"));

    // Padded so that the bound of 64 MiB and 64 for one is the lower of the two.
    std::string bomb = good + std::string(70000, '\0');
    put(bomb, 24, bomb.size() - kListBytes, 8);
    put(bomb, 16, (std::uint64_t{1} << 26) + 64 * (bomb.size() - kListBytes) + 1, 8);
    CHECK(holds(decode(bomb, volume).message, "bytes, allowed: at most"));

    // Damage behind the packing meets the same checks as without.
    long read = 0;
    for (std::size_t length = 0; length < good.size(); ++length) {
        std::string bytes = good;
        check_damaged({bytes.data(), length}, read);
        if (length < kListBytes + 8) continue;
        put(bytes, 24, length - kListBytes, 8);
        put(bytes, kListBytes, length - kListBytes - 8, 8);
        check_damaged({bytes.data(), length}, read);
    }
    CHECK(read == 0);
}

TEST_CASE("NanoVDB: few bytes cannot ask for much memory or time") {
    const Places p(kFloat);
    std::string bytes = plain(kFloat);
    Volume volume;

    // A tile of 128^3 at 512 512 512 makes a box of 640^3.
    const unsigned far = 4 * 1024 + 4 * 32 + 4;
    bytes[kListBytes + p.upper + 32 + far / 8] = char(1 << far % 8);
    const Status status = decode(bytes, volume);
    INFO(status.message);
    CHECK(status.code == Code::kLimit);
    CHECK(holds(status.message, "too many voxels, 262144000, allowed: at most"));
    CHECK(volume.density.empty());

    // Every entry of the lower node leads to one leaf: more visits than the tree states.
    bytes = plain(kFloat);
    for (unsigned n = 0; n < 4096; ++n)
        put(bytes, kListBytes + p.lower_table() + 8 * n, p.leaf - p.lower, 8);
    std::fill_n(bytes.begin() + std::ptrdiff_t(kListBytes + p.lower + 32 + 512), 512, char(255));
    CHECK(holds(decode(bytes, volume).message, "leaf: more than the tree states, allowed: 2"));
}

TEST_CASE("NanoVDB: cut short anywhere, it is a fault") {
    std::string bytes = plain(kFloat);
    long read = 0;
    for (std::size_t length = 0; length < bytes.size(); ++length)
        check_damaged({bytes.data(), length}, read);

    // The list and the head may say that the shorter grid is whole: every byte of heads and leaves,
    // and every 61st of the tables between.
    const Places p(kFloat);
    for (std::size_t length = 0; length < p.end;
         length += length < p.upper + 64 || length > p.leaf ? 1 : 61) {
        put(bytes, 16, length, 8);
        put(bytes, 24, length, 8);
        put(bytes, kListBytes + 32, length, 8);
        check_damaged({bytes.data(), kListBytes + length}, read);
    }
    CHECK(read == 0);
}

TEST_CASE("NanoVDB: damaged at random, it ends with a fault or a usable volume") {
    std::uint64_t state = 7;
    const auto below = [&](std::size_t n) {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        return std::size_t((state >> 33) % n);
    };
    long read = 0, tries = 0;
    for (const std::uint32_t type : {kFloat, kDouble, kFpN}) {
        const std::string good = plain(type);
        const Places p(type);
        // Tables are mostly empty: spend the damage on heads, masks, first entries and leaves.
        const std::size_t from[] = {0,
                                    kListBytes + p.tree,
                                    kListBytes + p.upper + 32 + 4096,
                                    kListBytes + p.upper_table(),
                                    kListBytes + p.lower + 32,
                                    kListBytes + p.lower_table(),
                                    kListBytes + p.leaf};
        const std::size_t span[] = {kListBytes + p.tree, 192, 8, 8, 1024, 4096, 2 * p.leaf_bytes};
        std::string bytes = good;
        for (int i = 0; i < 3000; ++i, ++tries) {
            std::size_t places[4];
            const std::size_t count = 1 + below(4);
            for (std::size_t n = 0; n < count; ++n) {
                const std::size_t part = below(7);
                places[n] = from[part] + below(span[part]);
                bytes[places[n]] = char(below(3) == 0 ? 255 * below(2) : below(256));
            }
            check_damaged({bytes.data(), bytes.size()}, read);
            for (std::size_t n = 0; n < count; ++n) bytes[places[n]] = good[places[n]];
        }
        CHECK(bytes == good);
    }
    MESSAGE(read, " of ", tries, " damaged files still hold a usable volume");
    CHECK(read < tries);
    CHECK(read > 0);
}
