// SPDX-License-Identifier: Apache-2.0
// The proof that the fixed-point sums cannot overflow.
// in: numbers of deposits and their bound -> out: binary places for which the worst case fits.
// docs/methods.md 2; docs/testing.md S60.
#include "src/plan/plan.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace pileus;

namespace {

/// Does the worst case fit with s places: one deposit in 31 bits, all of them in 62?
bool fits(int s, double deposits, double largest) {
    const double one = largest * double(std::uint64_t{1} << s) + 0.5;
    return one < 2147483648.0 && one * deposits < 4611686018427387904.0;  // 2^31, 2^62
}

}  // namespace

TEST_CASE("plan: the places chosen fit and one more would not (S60)") {
    for (double largest : {0.28, 1.0, 1.1, 6.5, 3000.0})
        for (double deposits = 1; deposits < 1e17; deposits *= 7) {
            const int s = fixed_point_places(deposits, largest);
            CAPTURE(deposits);
            CAPTURE(largest);
            if (s < 0) {
                CHECK_FALSE(fits(8, deposits, largest * 1.01));
                continue;
            }
            CHECK(fits(s, deposits, largest));
            // Bounds are a hair under the powers of two, so allow one per cent.
            if (s < 30) CHECK_FALSE(fits(s + 1, deposits, largest * 1.01));
        }
}

TEST_CASE("plan: no photon at all, and more than any sum can hold") {
    CHECK(fixed_point_places(0, 1) == 30);
    CHECK(fixed_point_places(1e17, 1) < 0);
    CHECK(fixed_point_places(1e300, 1) < 0);
}

TEST_CASE("S60: one deposit too many for the places costs a place, or the scene") {
    for (double largest : {0.28, 1.0, 1.1, 6.5})
        for (int s = 30; s >= 8; --s) {
            const double one = largest * double(std::uint64_t{1} << s) + 0.5;
            if (one >= 2147483520.0) continue;
            // Around the last number that fits; 64 is more than doubles of this size can blur.
            const double capacity = std::floor(4.6e18 / one);
            CAPTURE(s);
            CHECK(fixed_point_places(capacity - 64, largest) == s);
            CHECK(fixed_point_places(capacity + 64, largest) == (s > 8 ? s - 1 : -1));
        }
}

TEST_CASE("plan: whose sums photons are added to, by threads, bytes and the limit of memory") {
    const auto kind = [](AccumulationChoice choice, std::uint64_t threads, std::uint64_t set,
                         std::uint64_t others, bool exact = true) {
        const Accumulation a = plan_accumulation(choice, {threads, set, others, 4'000'000, exact});
        CHECK(a.shared == (a.kind == "shared"));
        CHECK((a.bytes > 0) == (a.kind == "private"));
        CHECK(a.bytes <= (a.kind == "private" ? threads * set : 0));
        return a.kind;
    };
    const auto automatic = AccumulationChoice::kAuto;
    CHECK(kind(automatic, 1, 900'000, 0) == "direct");
    CHECK(kind(AccumulationChoice::kShared, 1, 900'000, 0) == "direct");
    CHECK(kind(automatic, 2, 500'000, 0) == "private");
    CHECK(kind(automatic, 2, 500'001, 0) == "shared");
    CHECK(kind(automatic, 2, 500'000, 3'000'000) == "private");
    CHECK(kind(automatic, 2, 500'000, 3'000'001) == "shared");
    CHECK(kind(automatic, 2, 1, 5'000'000) == "shared");
    CHECK(kind(AccumulationChoice::kPrivate, 2, 500'001, 0) == "private");
    CHECK(kind(AccumulationChoice::kShared, 2, 1, 0) == "shared");

    // Before collectors are counted the bytes must bound either way.
    CHECK(kind(automatic, 2, 500'001, 0, false) == "private");
    CHECK(plan_accumulation(automatic, {2, 500'001, 0, 4'000'000, false}).bytes == 1'000'000);
}
