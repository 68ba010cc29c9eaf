// SPDX-License-Identifier: Apache-2.0
// NanoVDB files without the library: packed, greedy, cut short, and damaged at random.
// in: small files made here -> out: pass or fail.
// docs/testing.md, label io
#include <doctest/doctest.h>

#include "tests/io/nvdb_bytes.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using namespace pileus::test;

namespace {

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
    fault(14, 2, 2,
          holds(packing_library_text(), "blosc yes") ? "packed values: damaged" : "blosc");
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
