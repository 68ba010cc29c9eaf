// SPDX-License-Identifier: Apache-2.0
// Own log, exp, 1 - exp and sin/cos against the double library, over their whole domains.
// in: kernels_cpu/core/math.h -> out: largest errors within the stated ones, equal bits at every
// width. The bounds are those that kernels_cpu/core/math.h states; the figures found are printed.
#include "kernels_cpu/core/math.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "src/base/digest.h"
#include "tests/support/widths.h"

using namespace pileus;

namespace {

constexpr float kSmallestNormal = 0x1p-126f;
// The library's double result is within 1e-16 relative: 2^-29 ulp of a float, far below the slack.
constexpr double kTwoPi = 6.28318530717958648;

/// Distance in units of the last place of a float of `exact`'s size.
double ulps(float value, double exact) {
    int exponent;
    std::frexp(exact, &exponent);
    return std::fabs(double(value) - exact) * std::ldexp(1.0, 24 - std::max(exponent, -125));
}

struct Worst {
    double error = 0;
    float at = 0;
    void see(double e, float x) {
        if (!(e <= error)) error = e, at = x;
    }
    void print(const char* what, const char* unit) const {
        std::printf("%-30s largest error %.4g %s at %.9g\n", what, error, unit, double(at));
    }
};

/// Bits of floats from `first` on in order of magnitude, `f(x)` for each `stride`-th.
template <class Function>
void sweep(float first, float last, std::uint32_t stride, Function f) {
    const std::uint32_t end = bits_of_float(last);
    for (std::uint32_t b = bits_of_float(first); b <= end; b += stride * kThin) f(float_of(b));
}

double log_error(float x) {
    const double exact = std::log(double(x));
    return exact == 0 ? (log_(x) == 0 ? 0 : 1e9) : ulps(log_(x), exact);
}

/// Digest of all functions over 2^16 arguments each, in the order of the arguments.
template <int W>
std::uint64_t digest_of_functions() {
    using T = F<W>;
    Digest digest;
    for (int i = 0; i < 65536; i += W) {
        const auto k = iota<I<W>>() + i;
        const T u = to_float(k) * 0x1p-16f + 0x1p-17f;
        const T positive = reinterpret<T>(k * 0x7f00 + 0x00800000);
        const T logs = log_(positive), falls = exp_(u * -90.0f), rises = exp_(u * 90.0f);
        const T rest = one_minus_exp(u * u * 4.0f);
        const SinCos<T> turn = sincos_turns(u);
        for (int j = 0; j < W; ++j)
            for (const T& v : {logs, falls, rises, rest, turn.sine, turn.cosine})
                digest.f32(lane(v, j));
    }
    return digest.value();
}

template <int W>
void check_digest() {
    CHECK(digest_of_functions<W>() == 0x2dfb5bc0dce36fc1ull);
}

/// How often exp rises as x falls, or leaves [0.3, 1], over all floats of [-1, -2^-27].
template <int W>
std::int64_t exp_faults() {
    constexpr int kBlock = 4096;
    float y[kBlock + 1];
    y[kBlock] = 1.0f;
    std::int64_t faults = 0;
    const std::uint32_t first = bits_of_float(-0x1p-27f), last = bits_of_float(-1.0f);
    for (std::uint32_t b = first; b < last; b += kBlock * kThin) {
        y[0] = y[kBlock];
        for (std::uint32_t i = 1; i <= kBlock; i += W) {
            const F<W> v = exp_(reinterpret<F<W>>(iota<U<W>>() + (b + i)));
            std::memcpy(y + i, &v, sizeof v);
        }
        std::int32_t wrong = 0;
        for (int i = 0; i < kBlock; ++i) wrong += (y[i + 1] > y[i]) | !(y[i + 1] >= 0.3f);
        faults += wrong;
    }
    return faults;
}

}  // namespace

TEST_CASE("log: error <= 1 ulp over every multiple of 2^-24 and every exponent") {
    Worst worst;
    for (int k = 1; k < (1 << 24); k += int(kThin)) {
        const float x = float(k) * 0x1p-24f;
        worst.see(log_error(x), x);
    }
    sweep(1.0f, 2.0f, 1, [&](float x) { worst.see(log_error(x), x); });
    sweep(kSmallestNormal, 0x1.fffffep127f, 1009, [&](float x) { worst.see(log_error(x), x); });
    worst.print("log", "ulp");
    CHECK(worst.error <= 1.0);
    CHECK(log_(1.0f) == 0.0f);
    CHECK(log_(1.0f - 0x1p-24f) < 0.0f);
}

TEST_CASE("exp: error <= 1 ulp from -87 to 88") {
    Worst worst;
    const auto see = [&](float x) { worst.see(ulps(exp_(x), std::exp(double(x))), x); };
    sweep(-0x1p-27f, -87.0f, 41, see);
    sweep(0x1p-27f, 88.0f, 41, see);
    sweep(80.0f, 88.0f, 1, see);
    sweep(-80.0f, -87.0f, 1, see);
    worst.print("exp", "ulp");
    CHECK(worst.error <= 1.0);
}

TEST_CASE("exp: falls, stays in [0, 1] for x <= 0, never denormal, 0 below -87") {
    CHECK(exp_faults<4>() == 0);
    std::int64_t faults = 0;
    float previous = 1.0f;
    sweep(-1.0f, -90.0f, 1, [&](float x) {
        const float y = exp_(x);
        faults += y > previous || y < 0.0f || (y > 0.0f && y < kSmallestNormal);
        faults += (y == 0.0f) != (x < -87.0f);
        previous = y;
    });
    CHECK(faults == 0);
    CHECK(exp_(0.0f) == 1.0f);
    CHECK(exp_(-0.0f) == 1.0f);
    CHECK(exp_(-87.1f) == 0.0f);
    CHECK(exp_(-1e30f) == 0.0f);
    CHECK(exp_(1e30f) == exp_(88.0f));
}

TEST_CASE("1 - exp(-x): relative error <= 2^-22, rises, in [0, 1]") {
    Worst worst;
    std::int64_t faults = 0;
    float previous = 0.0f;
    const auto see = [&](float x) {
        const double exact = -std::expm1(-double(x));
        const float y = one_minus_exp(x);
        worst.see(std::fabs(double(y) / exact - 1.0), x);
        faults += y < previous || y > 1.0f;
        previous = y;
    };
    sweep(1e-30f, 0.3f, 331, see);
    sweep(0.3f, 0.4f, 1, see);
    sweep(0.4f, 88.0f, 331, see);
    worst.print("1 - exp(-x)", "relative");
    CHECK(worst.error <= 0x1p-22);
    CHECK(faults == 0);
    CHECK(one_minus_exp(0.0f) == 0.0f);
    CHECK(one_minus_exp(1e30f) == 1.0f);
}

TEST_CASE("sin and cos of turns: error <= 1.2e-7 at every multiple of 2^-24") {
    Worst sine, cosine, norm;
    for (int k = 0; k <= (1 << 24); k += int(kThin)) {
        const float u = float(k) * 0x1p-24f;
        const SinCos<float> turn = sincos_turns(u);
        const double s = double(turn.sine), c = double(turn.cosine);
        sine.see(std::fabs(s - std::sin(kTwoPi * double(u))), u);
        cosine.see(std::fabs(c - std::cos(kTwoPi * double(u))), u);
        norm.see(std::fabs(s * s + c * c - 1.0), u);
    }
    sine.print("sin of turns", "absolute");
    cosine.print("cos of turns", "absolute");
    norm.print("sin^2 + cos^2 - 1", "absolute");
    CHECK(sine.error <= 1.2e-7);
    CHECK(cosine.error <= 1.2e-7);
    // Each term carries at most twice its own error: 2 (|s| + |c|) 1.2e-7 <= 3.4e-7.
    CHECK(norm.error <= 3.4e-7);
}

TEST_CASE("sin and cos are exact at the quarter turns") {
    const float expected[5][2] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}, {0, 1}};
    for (int q = 0; q <= 4; ++q) {
        const SinCos<float> turn = sincos_turns(float(q) * 0.25f);
        CHECK(turn.sine == expected[q][0]);
        CHECK(turn.cosine == expected[q][1]);
    }
}

TEST_CASE("angle of a point: error <= 3e-8 turns all around, for large and small points") {
    Worst worst;
    for (int k = 0; k < (1 << 22); k += int(kThin)) {
        const double angle = kTwoPi * (double(k) + 0.5) / double(1 << 22);
        for (float size : {1.0f, 1e-15f, 1e15f}) {
            const float x = float(std::cos(angle)) * size, y = float(std::sin(angle)) * size;
            const double exact = std::atan2(double(y), double(x)) / kTwoPi;
            worst.see(std::fabs(double(atan2_turns(y, x)) - exact), float(angle));
        }
    }
    worst.print("angle in turns", "absolute");
    CHECK(worst.error <= 3e-8);
    CHECK(atan2_turns(0.0f, 1.0f) == 0.0f);
    CHECK(atan2_turns(1.0f, 1.0f) == 0.125f);
    CHECK(atan2_turns(1.0f, 0.0f) == 0.25f);
    CHECK(atan2_turns(0.0f, -1.0f) == 0.5f);
    CHECK(atan2_turns(-1.0f, 0.0f) == -0.25f);
    CHECK(atan2_turns(0.0f, 0.0f) == 0.0f);
}

template <int W>
void check_angle_digest() {
    Digest digest;
    for (int i = 0; i < 65536; i += W) {
        const F<W> u = to_float(iota<I<W>>() + i) * 0x1p-16f;
        const F<W> angle = atan2_turns(u * u - 0.5f, u - 0.3f);
        for (int j = 0; j < W; ++j) digest.f32(lane(angle, j));
    }
    CHECK(digest.value() == 0x484a4353c277d80eull);
}

TEST_CASE("the angle of a point has the same stored digest at every width") {
    PILEUS_EACH_WIDTH(check_angle_digest);
}

TEST_CASE("every function gives the same stored digest at every width") {
    PILEUS_EACH_WIDTH(check_digest);
}
