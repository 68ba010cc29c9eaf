// SPDX-License-Identifier: Apache-2.0
// Digests against published values, whatever the pieces that they are made from; FNV-1a of choices.
// in: xxHash's own test bytes -> out: equality.
#include "src/base/digest.h"

#include <doctest/doctest.h>

#include <cstring>
#include <vector>

#include "src/base/fnv1a64.h"

using namespace pileus;

namespace {

/// The bytes that xxHash's sanity checks hash.
std::vector<unsigned char> test_bytes() {
    std::vector<unsigned char> bytes(2240);
    std::uint64_t state = 2654435761u;
    for (unsigned char& b : bytes) {
        b = static_cast<unsigned char>(state >> 56);
        state *= 11400714785074694797u;
    }
    return bytes;
}

struct Known {
    std::size_t count;
    const char* hex;
};

/// XXH3_64bits without a seed, from xxHash 0.8: each way that lengths are treated in.
constexpr Known kPublished[] = {
    {0, "2d06800538d394c2"},   {1, "c44bdff4074eecdb"},    {6, "27b56a84cd2d7325"},
    {12, "a713daf0dfbb77e7"},  {24, "a3fe70bf9d3510eb"},   {48, "397da259ecba1f11"},
    {80, "bcdefbbb2c47c90a"},  {195, "cd94217ee362ec3a"},  {403, "cdeb804d65c6dea4"},
    {512, "617e49599013cb6b"}, {2048, "dd59e2c3a5f038e0"}, {2240, "6e73a90539cf2948"}};

}  // namespace

TEST_CASE("digest: published values, in one piece and in many") {
    const std::vector<unsigned char> bytes = test_bytes();
    for (const Known& known : kPublished)
        for (const std::size_t piece :
             {std::size_t(1), std::size_t(7), std::size_t(300), bytes.size()}) {
            CAPTURE(known.count);
            CAPTURE(piece);
            Digest digest;
            for (std::size_t at = 0; at < known.count; at += piece)
                digest.bytes(bytes.data() + at,
                             known.count - at < piece ? known.count - at : piece);
            CHECK(digest.hex() == known.hex);
            CHECK(digest.hex() == known.hex);  // asking changes nothing
        }
}

TEST_CASE("digest: numbers are their bytes, the lowest first, one by one or in spans") {
    // More than one block of a machine that turns them.
    const std::vector<unsigned char> bytes = test_bytes();
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::vector<std::int64_t> longs(bytes.size() / 8);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        words[i / 4] |= std::uint32_t(bytes[i]) << (8 * (i % 4));
        longs[i / 8] =
            std::int64_t(std::uint64_t(longs[i / 8]) | std::uint64_t(bytes[i]) << (8 * (i % 8)));
    }
    std::vector<float> floats(words.size());
    std::vector<double> doubles(longs.size());
    std::memcpy(floats.data(), words.data(), bytes.size());
    std::memcpy(doubles.data(), longs.data(), bytes.size());
    Digest all[8];
    all[0].words(Span<const std::uint32_t>{words.data(), words.size()});
    all[1].integers({longs.data(), longs.size()});
    all[2].floats({floats.data(), floats.size()});
    all[3].doubles({doubles.data(), doubles.size()});
    for (const std::uint32_t v : words) all[4].u32(v);
    for (const std::int64_t v : longs) all[5].u64(std::uint64_t(v));
    for (const float v : floats) all[6].f32(v);
    for (const unsigned char v : bytes) all[7].byte(v);
    for (const Digest& digest : all) CHECK(digest.hex() == "6e73a90539cf2948");
    Digest nothing;
    nothing.floats({});
    CHECK(nothing.hex() == "2d06800538d394c2");
}

TEST_CASE("FNV-1a 64: published values, and lots that pictures with particles stand on") {
    const auto of = [](const std::string& text) { return fnv1a64({text.data(), text.size()}); };
    CHECK(of("") == 0xcbf29ce484222325u);
    CHECK(of("a") == 0xaf63dc4c8601ec8cu);
    CHECK(of("foobar") == 0x85944171f73967e8u);
    Fnv1a64 numbers;
    numbers.u32(0x6f6f66);  // "foo" and a zero
    CHECK(numbers.value() == of(std::string("foo\0", 4)));
    const float one = 1;
    Fnv1a64 floats;
    floats.floats({&one, 1});
    CHECK(floats.value() == of(std::string("\0\0\x80\x3f", 4)));
    CHECK(lot_of(of("foobar")) < 0x100000000u);
}
