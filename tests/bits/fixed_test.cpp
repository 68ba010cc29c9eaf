// SPDX-License-Identifier: Apache-2.0
// Floats to whole quanta: rounding half away from zero, clamping, and sums without an order.
// in: kernels_cpu/core/fixed.h -> out: equality of integers with std::llround in double.
// docs/methods.md 2 (accumulation), docs/testing.md S59, S61.
#include "kernels_cpu/core/fixed.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "kernels_cpu/core/rng.h"
#include "tests/support/widths.h"

using namespace pileus;

namespace {

constexpr std::int32_t kLimit = 2147483520;

std::int64_t exact(float value, float scale) {
    const double product = double(value * scale);
    if (product >= double(kLimit)) return kLimit;
    if (product <= -double(kLimit)) return -kLimit;
    return std::llround(product);
}

/// Disagreements with the exact rule, and breaches of symmetry, for each `stride`-th float.
std::int64_t faults(float first, float last, std::uint32_t stride) {
    std::int64_t count = 0;
    const std::uint32_t end = bits_of_float(last);
    for (std::uint32_t b = bits_of_float(first); b <= end; b += stride) {
        const float v = float_of(b);
        const std::int32_t q = quantise(v, 1.0f);
        count += q != exact(v, 1.0f) || quantise(-v, 1.0f) != -q;
    }
    return count;
}

template <int W>
void check_lanes() {
    const float inputs[16] = {0.0f, -0.0f, 0.5f,  -0.5f,  0.49999997f, -0.49999997f, 1.5f, -1.5f,
                              2.5f, -2.5f, 1e20f, -1e20f, 8388609.0f,  -8388609.0f,  3.0f, 1e-40f};
    const std::int32_t outputs[16] = {0, 0,  1,      -1,      0,       0,        2, -2,
                                      3, -3, kLimit, -kLimit, 8388609, -8388609, 3, 0};
    for (int i = 0; i < 16; i += W) {
        const auto q = quantise(from_array<F<W>>(inputs + i), 1.0f);
        for (int k = 0; k < W; ++k) CHECK(lane(q, k) == outputs[i + k]);
    }
}

template <int W>
void check_not_finite() {
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(lane(quantise(all<F<W>>(inf), 1.0f), W - 1) == kLimit);
    CHECK(lane(quantise(all<F<W>>(-inf), 1.0f), W - 1) == -kLimit);
    CHECK(lane(quantise(all<F<W>>(nan), 1.0f), W - 1) == kLimit);
    CHECK(lane(quantise(all<F<W>>(-nan), 1.0f), W - 1) == kLimit);
}

}  // namespace

TEST_CASE("quantise rounds half away from zero, symmetrically, at every width") {
    PILEUS_EACH_WIDTH(check_lanes);
    CHECK(faults(0.25f, 4.0f, 1) == 0);
    CHECK(faults(0x1p21f, 0x1p25f, 1) == 0);
    CHECK(faults(0.0f, 3e38f, 211) == 0);
}

TEST_CASE("quantise applies the scale before rounding") {
    for (const float scale : {1.0f, 256.0f, 65536.0f, 0x1p20f})
        for (const float v : {0.1f, 0.333f, 7.77f, 1000.125f})
            CHECK(quantise(v, scale) == exact(v, scale));
}

TEST_CASE("quantise clamps what no integer holds, and NaN, alike everywhere") {
    PILEUS_EACH_WIDTH(check_not_finite);
    CHECK(quantise(2147483392.0f, 1.0f) == 2147483392);
    CHECK(quantise(2147483520.0f, 1.0f) == kLimit);
    CHECK(quantise(2147483648.0f, 1.0f) == kLimit);
    CHECK(quantise(-2147483648.0f, 1.0f) == -kLimit);
}

TEST_CASE("a sum of quanta does not depend on its order; a float sum does") {
    constexpr std::uint32_t kCount = 100000;
    std::vector<float> values;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const Words<std::uint32_t> w = threefry(5u, 0u, i, 0u);
        values.push_back((uniform(w.a) - 0.25f) * (w.b % 1000u == 0u ? 1e3f : 1.0f));
    }
    std::int64_t up = 0, down = 0, shuffled = 0;
    float float_up = 0, float_down = 0;
    double sum = 0;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        up += quantise(values[i], 65536.0f);
        down += quantise(values[kCount - 1 - i], 65536.0f);
        shuffled += quantise(values[std::uint64_t(i) * 7919u % kCount], 65536.0f);
        float_up += values[i];
        float_down += values[kCount - 1 - i];
        sum += double(values[i]);
    }
    CHECK(up == down);
    CHECK(up == shuffled);
    CHECK(float_up != float_down);
    // S61: at most half a quantum each.
    CHECK(std::fabs(double(up) / 65536.0 - sum) <= kCount * 0.5 / 65536.0);
}
