// SPDX-License-Identifier: Apache-2.0
// Random numbers: published vectors, exact uniforms, streams that do not meet.
// in: kernels_cpu/core/rng.h -> out: equality of bits, chi-square of neighbouring counters.
// Vectors: Random123 (Salmon et al. 2011), file kat_vectors, threefry2x32-20.
#include "kernels_cpu/core/rng.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "src/base/digest.h"
#include "src/base/random_streams.h"
#include "tests/support/chi_square.h"
#include "tests/support/widths.h"

using namespace pileus;

namespace {

using Word = std::uint32_t;

template <int W>
void check_known_answers() {
    const Word vectors[3][6] = {
        {0, 0, 0, 0, 0x6b200159u, 0x99ba4efeu},
        {~0u, ~0u, ~0u, ~0u, 0x1cb996fcu, 0xbb002be7u},
        {0x13198a2eu, 0x03707344u, 0x243f6a88u, 0x85a308d3u, 0xc4923a9cu, 0x483df7a0u}};
    for (const auto& v : vectors) {
        const auto w = threefry(v[0], v[1], all<U<W>>(v[2]), all<U<W>>(v[3]));
        for (int i = 0; i < W; ++i) {
            CHECK(lane(w.a, i) == v[4]);
            CHECK(lane(w.b, i) == v[5]);
        }
    }
}

/// Words, uniform and open uniform of 4096 counters, in the order of the counters.
template <int W>
std::uint64_t digest_of_words() {
    Digest digest;
    for (Word i = 0; i < 4096; i += W) {
        const U<W> c0 = iota<U<W>>() + i;
        const auto w = threefry(0x01234567u, 0x89abcdefu, c0, c0 * 0x9e3779b9u);
        const auto closed = uniform(w.b), open = uniform_open(w.b);
        for (int k = 0; k < W; ++k) {
            digest.u32(lane(w.a, k));
            digest.f32(lane(closed, k));
            digest.f32(lane(open, k));
        }
    }
    return digest.value();
}

template <int W>
void check_digest() {
    CHECK(digest_of_words<W>() == 0x847dae43c298ef76ull);
}

/// Counts of (x, y) over 64 x 64 cells, pairs made by `pair(i)`.
template <class Pair>
ChiSquare count_pairs(std::int64_t samples, Pair pair) {
    std::vector<std::int64_t> counts(64 * 64);
    for (std::int64_t i = 0; i < samples; ++i) {
        const Words<float> p = pair(Word(i));
        ++counts[std::size_t(p.a * 64.0f) * 64 + std::size_t(p.b * 64.0f)];
    }
    return chi_square(counts, std::vector<double>(64 * 64, double(samples) / (64 * 64)));
}

}  // namespace

TEST_CASE("threefry gives the published words at every width") {
    PILEUS_EACH_WIDTH(check_known_answers);
}

TEST_CASE("threefry gives the same stored digest at every width") {
    PILEUS_EACH_WIDTH(check_digest);
}

TEST_CASE("uniform is exact over all its 2^24 values, in [0, 1)") {
    std::int64_t wrong = 0;
    for (Word k = 0; k < (1u << 24); ++k) {
        const float low = uniform(k << 8), high = uniform((k << 8) | 0xffu);
        wrong += double(low) != double(k) / 16777216.0 || high != low || !(low < 1.0f);
    }
    CHECK(wrong == 0);
    CHECK(uniform(Word(0)) == 0.0f);
    CHECK(uniform(~Word(0)) == 0x1.fffffep-1f);
}

TEST_CASE("uniform_open is exact over all its 2^23 values, in (0, 1)") {
    std::int64_t wrong = 0;
    for (Word k = 0; k < (1u << 23); ++k) {
        const float low = uniform_open(k << 9), high = uniform_open((k << 9) | 0x1ffu);
        const bool inside = low > 0.0f && low < 1.0f;
        wrong += double(low) != (double(k) + 0.5) / 8388608.0 || high != low || !inside;
    }
    CHECK(wrong == 0);
    CHECK(uniform_open(Word(0)) == 0x1p-24f);
    CHECK(uniform_open(~Word(0)) == 1.0f - 0x1p-24f);
}

TEST_CASE("keys of seeds, streams and high words all differ") {
    // 64-bit keys: 2^18 of them meet by chance once in 5e8 choices of this test.
    std::vector<std::uint64_t> keys;
    for (Word seed = 0; seed < 64; ++seed)
        for (Word stream = 0; stream < 64; ++stream)
            for (Word high = 0; high < 32; ++high) {
                for (const std::uint64_t s : {std::uint64_t(seed), std::uint64_t(seed + 1) << 32}) {
                    const Key k = make_key(s, stream, high);
                    keys.push_back(std::uint64_t(k.k0) << 32 | k.k1);
                }
            }
    std::sort(keys.begin(), keys.end());
    CHECK(std::adjacent_find(keys.begin(), keys.end()) == keys.end());
}

TEST_CASE("photons on both sides of 2^32 draw different words") {
    const Key low = make_key(7, 0, 0), high = make_key(7, 0, 1);
    for (const Word photon : {0u, 1u, 2u, ~0u}) {
        const auto a = threefry(low.k0, low.k1, photon, 0u);
        const auto b = threefry(high.k0, high.k1, photon, 0u);
        CHECK((a.a != b.a || a.b != b.b));
    }
}

TEST_CASE("streams: names and numbers differ, and the numbers are those of earlier pictures") {
    const Word kept[] = {1, 2, 3, 8, 17, 18, 19, 31, 32, 0x63756d75u, 0x6e6f6973u};
    std::vector<Word> numbers;
    std::vector<std::string> names;
    for (const RandomStreamRow& row : kRandomStreams) {
        numbers.push_back(row.number);
        names.push_back(row.name);
        CHECK(std::string(row.use) != "");
    }
    for (const Word number : kept) CHECK(std::count(numbers.begin(), numbers.end(), number) == 1);
    std::sort(numbers.begin(), numbers.end());
    std::sort(names.begin(), names.end());
    CHECK(std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end());
    CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
}

TEST_CASE("neighbouring counters and streams are independent in pairs") {
    CHECK(two_stage_chi_square("photon i, i+1", 11, [](std::uint64_t seed, std::int64_t n) {
        const Key k = make_key(seed, 0, 0);
        return count_pairs(n, [&](Word i) -> Words<float> {
            const auto a = threefry(k.k0, k.k1, i, 0u), b = threefry(k.k0, k.k1, i + 1, 0u);
            return {uniform(a.a), uniform(b.a)};
        });
    }));
    CHECK(two_stage_chi_square("draw 0, 1 of a photon", 12, [](std::uint64_t seed, std::int64_t n) {
        const Key k = make_key(seed, 0, 0);
        return count_pairs(n, [&](Word i) -> Words<float> {
            const auto a = threefry(k.k0, k.k1, i, 0u), b = threefry(k.k0, k.k1, i, 1u);
            return {uniform(a.b), uniform(b.a)};
        });
    }));
    CHECK(two_stage_chi_square("two words of a call", 13, [](std::uint64_t seed, std::int64_t n) {
        const Key k = make_key(seed, 0, 0);
        return count_pairs(n, [&](Word i) -> Words<float> {
            const auto a = threefry(k.k0, k.k1, i, 5u);
            return {uniform(a.a), uniform_open(a.b)};
        });
    }));
    CHECK(two_stage_chi_square("stream 0, 1", 14, [](std::uint64_t seed, std::int64_t n) {
        const Key k = make_key(seed, 0, 0), m = make_key(seed, 1, 0);
        return count_pairs(n, [&](Word i) -> Words<float> {
            const auto a = threefry(k.k0, k.k1, i, 0u), b = threefry(m.k0, m.k1, i, 0u);
            return {uniform(a.a), uniform(b.a)};
        });
    }));
}

TEST_CASE("the chi-square helper itself: known quantiles and a biased die") {
    // Quantiles of chi-square from Abramowitz, Stegun table 26.8, given to 5 digits.
    CHECK(upper_gamma(0.5, 0.5 * 3.84146) == doctest::Approx(0.05).epsilon(1e-4));
    CHECK(upper_gamma(5.0, 0.5 * 18.3070) == doctest::Approx(0.05).epsilon(1e-4));
    CHECK(upper_gamma(50.0, 0.5 * 149.449) == doctest::Approx(0.001).epsilon(1e-3));
    CHECK(chi_square({5200, 4800}, {5000, 5000}).p < 1e-4);
    CHECK(chi_square({5020, 4980}, {5000, 5000}).p > 0.5);
}
