// SPDX-License-Identifier: Apache-2.0
// Every verb of the lanes against plain scalar C++, at every width.
// in: kernels_cpu/core/lanes.h, lanes_verbs.h -> out: equality of bits, NaN and signed zeros
// included. docs/architecture.md, "Kernels: written once".
#include "kernels_cpu/core/lanes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/support/widths.h"

using namespace pileus;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kA[16] = {1.0f, -0.0f, 0.0f,  kNan,  3.5f,  -2.5f, kInf, -kInf,
                          2.0f, kNan,  1e-3f, -7.0f, 0.75f, -1e9f, 5.0f, -3.0f};
constexpr float kB[16] = {2.0f,  0.0f,  -0.0f, 1.0f, kNan,   -2.25f, 4.0f, kInf,
                          -2.0f, -1.0f, -1.0f, 7.0f, -0.75f, 1e9f,   kNan, -3.0f};
constexpr float kWhole[16] = {0.0f,       -0.0f,       0.5f,          -0.5f,
                              1.0f,       -1.0f,       1.75f,         -1.75f,
                              8388607.5f, -8388607.5f, 2147483520.0f, -2147483648.0f,
                              0x1p-149f,  -0x1p-149f,  -3.0f,         -2.0000002f};

bool same(float a, float b) { return bits_of_float(a) == bits_of_float(b); }

template <int W>
void check_choices() {
    for (int i = 0; i < 16; i += W) {
        const F<W> a = from_array<F<W>>(kA + i), b = from_array<F<W>>(kB + i);
        const F<W> low = min_(a, b), high = max_(a, b), mixed = select(a < b, b, a);
        for (int k = 0; k < W; ++k) {
            // Compare and select: where a comparison with NaN is false, the second one is taken.
            const float x = kA[i + k], y = kB[i + k];
            CHECK(same(lane(low, k), x < y ? x : y));
            CHECK(same(lane(high, k), x > y ? x : y));
            CHECK(same(lane(mixed, k), x < y ? y : x));
        }
    }
}

template <int W>
void check_signs() {
    for (int i = 0; i < 16; i += W) {
        const F<W> a = from_array<F<W>>(kA + i), b = from_array<F<W>>(kB + i);
        const F<W> size = abs_(a), copied = copysign_(a, b);
        for (int k = 0; k < W; ++k) {
            CHECK(same(lane(size, k), std::fabs(kA[i + k])));
            CHECK(same(lane(copied, k), std::copysign(kA[i + k], kB[i + k])));
        }
    }
}

template <int W>
void check_conversions() {
    for (int i = 0; i < 16; i += W) {
        const F<W> v = from_array<F<W>>(kWhole + i);
        const auto down = floor_int(v), cut = to_int(v);
        const auto back = to_float(cut);
        for (int k = 0; k < W; ++k) {
            const double x = double(kWhole[i + k]);
            CHECK(lane(down, k) == std::int32_t(std::floor(x)));
            CHECK(lane(cut, k) == std::int32_t(std::trunc(x)));
            CHECK(lane(back, k) == float(std::int32_t(std::trunc(x))));
        }
    }
    const std::int32_t odd = 16777217;
    CHECK(lane(to_float(all<I<W>>(odd)), W - 1) == 16777216.0f);
}

template <int W>
void check_masks() {
    const std::int32_t limit = W == 1 ? 2 : 1 << (W < 16 ? W : 16);
    std::int32_t wrong = 0;
    for (std::int32_t pattern = 0; pattern < limit; ++pattern) {
        I<W> v{};
        for (int k = 0; k < W; ++k) set_lane(v, k, (pattern >> k) & 1);
        const M<W> m = v != 0;
        wrong += bits_of(m) != std::uint32_t(pattern) || any(m) != (pattern != 0);
        wrong += bits_of(lnot(m)) != std::uint32_t(limit - 1 - pattern);
    }
    CHECK(wrong == 0);
}

template <int W>
void check_memory() {
    float floats[64];
    std::int32_t integers[64];
    for (int i = 0; i < 64; ++i) floats[i] = float(i) * 1.25f - 7.0f, integers[i] = i * i - 900;
    floats[63] = -0.0f, floats[0] = kNan;
    for (int start = 0; start < 64; ++start) {
        const auto index = (iota<I<W>>() * 23 + start) & 63;
        const auto f = gather(floats, index);
        const auto n = gather(integers, index);
        for (int k = 0; k < W; ++k) {
            const int at = (k * 23 + start) & 63;
            CHECK(lane(index, k) == at);
            CHECK(same(lane(f, k), floats[at]));
            CHECK(lane(n, k) == integers[at]);
        }
    }
}

template <int W>
void check_roots() {
    std::int64_t wrong = 0;
    for (std::uint32_t b = 0; b < 0x7f800000u; b += 9973u * W) {
        const F<W> v = reinterpret<F<W>>(iota<U<W>>() * 9973u + b);
        const F<W> root = sqrt_(v);
        for (int k = 0; k < W; ++k) {
            // The double root rounded once more is the float root: 53 >= 2 * 24 + 2.
            const float x = lane(v, k);
            if (x >= 0) wrong += !same(lane(root, k), float(std::sqrt(double(x))));
        }
    }
    CHECK(wrong == 0);
    CHECK(same(lane(sqrt_(all<F<W>>(-0.0f)), W - 1), -0.0f));
    const float root = lane(sqrt_(all<F<W>>(-1.0f)), 0);
    CHECK(root != root);
}

template <int W>
void check_broadcast() {
    static_assert(width_of<F<W>> == W && width_of<I<W>> == W && width_of<U<W>> == W, "width");
    static_assert(width_of<M<W>> == W, "width of a mask");
    for (int k = 0; k < W; ++k) {
        CHECK(same(lane(all<F<W>>(-0.0f), k), -0.0f));
        CHECK(same(lane(all<F<W>>(0.0f), k), 0.0f));
        CHECK(lane(all<F<W>>(-kInf), k) == -kInf);
        CHECK(lane(all<I<W>>(-5), k) == -5);
        CHECK(lane(all<U<W>>(0xfffffffeu), k) == 0xfffffffeu);
        CHECK(lane(iota<U<W>>(), k) == std::uint32_t(k));
        CHECK(lane(iota<F<W>>(), k) == float(k));
    }
    F<W> v = all<F<W>>(1.0f);
    set_lane(v, W - 1, 9.0f);
    CHECK(lane(v, W - 1) == 9.0f);
    CHECK((W == 1 || lane(v, 0) == 1.0f));
    CHECK(lane(reinterpret<U<W>>(all<F<W>>(-2.0f)), W - 1) == 0xc0000000u);
}

}  // namespace

TEST_CASE("all, iota, lane, set_lane, reinterpret: broadcasts keep -0") {
    PILEUS_EACH_WIDTH(check_broadcast);
}

TEST_CASE("min, max, select compare and choose, NaN included") { PILEUS_EACH_WIDTH(check_choices); }

TEST_CASE("abs and copysign move the sign bit alone") { PILEUS_EACH_WIDTH(check_signs); }

TEST_CASE("floor_int, to_int, to_float follow the scalar conversions") {
    PILEUS_EACH_WIDTH(check_conversions);
}

TEST_CASE("any, bits_of, lnot over every pattern of lanes") { PILEUS_EACH_WIDTH(check_masks); }

TEST_CASE("gather reads the lane's own index") { PILEUS_EACH_WIDTH(check_memory); }

TEST_CASE("sqrt is correctly rounded") { PILEUS_EACH_WIDTH(check_roots); }
