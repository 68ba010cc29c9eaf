// SPDX-License-Identifier: Apache-2.0
// The frame around a direction, and a million turns one after another.
// in: kernels_cpu/core/vec.h -> out: orthonormality, unit length within 4 ulp, small angles.
// docs/testing.md S10, S11; Duff et al. 2017.
#include "kernels_cpu/core/vec.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/media/phase.h"
#include "src/base/digest.h"
#include "tests/support/widths.h"

using namespace pileus;

namespace {

using V = Vec<float>;

double length(const V& v) {
    const double x = double(v.x), y = double(v.y), z = double(v.z);
    return std::sqrt(x * x + y * y + z * z);
}
double product(const V& a, const V& b) {
    return double(a.x) * double(b.x) + double(a.y) * double(b.y) + double(a.z) * double(b.z);
}
double determinant(const V& a, const V& b, const V& c) {
    const double x = double(b.y) * double(c.z) - double(b.z) * double(c.y);
    const double y = double(b.z) * double(c.x) - double(b.x) * double(c.z);
    const double z = double(b.x) * double(c.y) - double(b.y) * double(c.x);
    return double(a.x) * x + double(a.y) * y + double(a.z) * z;
}

V direction(std::uint32_t i) {
    const Words<std::uint32_t> w = threefry(8u, 9u, i, 0u);
    const float z = 2.0f * uniform_open(w.a) - 1.0f, r = sqrt_(1.0f - z * z);
    const SinCos<float> turn = sincos_turns(uniform(w.b));
    return normalized(V{r * turn.cosine, r * turn.sine, z});
}

/// The axes with zeros of both signs, with 1e-30 and 1e-4 beside the one, and 1000 others.
std::vector<V> directions() {
    std::vector<V> list;
    for (const float one : {1.0f, -1.0f})
        for (const float a : {0.0f, -0.0f, 1e-30f, -1e-30f, 1e-4f, -1e-4f})
            for (const float b : {0.0f, -0.0f, 1e-30f, -1e-30f, 1e-4f, -1e-4f}) {
                list.push_back(normalized(V{one, a, b}));
                list.push_back(normalized(V{a, one, b}));
                list.push_back(normalized(V{a, b, one}));
            }
    for (std::uint32_t i = 0; i < 1000; ++i) list.push_back(direction(i));
    return list;
}

/// A walk of `steps` HG turns from +z, lane k keyed by k; digest of the last directions.
template <int W>
std::uint64_t walk(int steps) {
    using T = F<W>;
    Digest digest;
    for (std::uint32_t first = 0; first < 16; first += W) {
        Vec<T> d{T{}, T{}, all<T>(1.0f)};
        for (int i = 0; i < steps; ++i) {
            const auto w = threefry(1u, 2u, iota<U<W>>() + first, all<U<W>>(std::uint32_t(i)));
            const Turn<T> turn = hg_sample(all<T>(0.85f), uniform_open(w.a));
            const SinCos<T> phi = sincos_turns(uniform(w.b));
            d = turned(d, 1.0f - turn.one_minus_cos, turn.sine, phi.cosine, phi.sine);
        }
        for (int k = 0; k < W; ++k) {
            digest.f32(lane(d.x, k));
            digest.f32(lane(d.y, k));
            digest.f32(lane(d.z, k));
        }
    }
    return digest.value();
}

template <int W>
void check_digest() {
    CHECK(walk<W>(500) == 0x6688ac0be4ae43d3ull);
}

}  // namespace

TEST_CASE("S10: the frame is orthonormal and right-handed around every direction") {
    double worst_det = 0, worst_dot = 0, worst_forward = 0;
    for (const V& d : directions()) {
        const V t = turned(d, 0.0f, 1.0f, 1.0f, 0.0f);
        const V n = turned(d, 0.0f, 1.0f, 0.0f, 1.0f);
        const V f = turned(d, 1.0f, 0.0f, 1.0f, 0.0f);
        const V gap{f.x - d.x, f.y - d.y, f.z - d.z};
        // fmax would hide a NaN.
        const double det = std::fabs(determinant(t, n, d) - 1);
        CHECK(det <= 1e-6);
        worst_det = std::fmax(worst_det, det);
        for (const double p : {product(t, n), product(t, d), product(n, d)})
            worst_dot = std::fmax(worst_dot, std::fabs(p));
        worst_forward = std::fmax(worst_forward, length(gap));
    }
    std::printf("frame: |det-1| %.3g, dot products %.3g, no turn moves by %.3g\n", worst_det,
                worst_dot, worst_forward);
    // A handful of roundings of 6e-8, on numbers up to 2.
    CHECK(worst_dot <= 4e-7);
    CHECK(worst_forward <= 2e-7);
}

TEST_CASE("turned: the cosine with the axis is the one asked for") {
    double worst = 0;
    for (const V& d : directions())
        for (std::uint32_t i = 0; i < 64; ++i) {
            const Words<std::uint32_t> w = threefry(1u, 1u, i, 0u);
            const Turn<float> turn = hg_sample(0.0f, uniform_open(w.a));
            const SinCos<float> phi = sincos_turns(uniform(w.b));
            const float c = 1.0f - turn.one_minus_cos;
            const V out = turned(d, c, turn.sine, phi.cosine, phi.sine);
            const double error = std::fabs(product(out, d) - double(c));
            worst = std::fmax(worst, error <= 1 ? error : 1);
        }
    std::printf("turned: cosine within %.3g\n", worst);
    // The frame's error (4e-7) plus the roundings of a dot product and of the length.
    CHECK(worst <= 6e-7);
}

TEST_CASE("S11: a million turns stay within 4 ulp of unit length") {
    for (const float g : {0.0f, 0.85f, -0.6f, 0.9999f}) {
        V d{0.0f, -0.0f, 1.0f};
        double worst = 0;
        std::int64_t faults = 0;
        for (std::uint32_t i = 0; i < 1000000; ++i) {
            const Words<std::uint32_t> w = threefry(6u, 6u, i, 0u);
            const Turn<float> turn = hg_sample(g, uniform_open(w.a));
            const SinCos<float> phi = sincos_turns(uniform(w.b));
            d = turned(d, 1.0f - turn.one_minus_cos, turn.sine, phi.cosine, phi.sine);
            const double error = std::fabs(length(d) - 1);
            faults += !(error <= 4 * 0x1p-23);
            worst = std::fmax(worst, error);
        }
        std::printf("1e6 turns, g %g: ||d|-1| <= %.2f ulp\n", double(g), worst * 0x1p23);
        CHECK(faults == 0);
    }
}

TEST_CASE("one_minus_cosine resolves angles that 1 - dot cannot") {
    for (const double angle : {1e-6, 1e-4, 1e-2, 1.0, 3.0}) {
        const V a{0.0f, 0.0f, 1.0f};
        const V b{float(std::sin(angle)), 0.0f, float(std::cos(angle))};
        const double exact = 2 * std::sin(0.5 * angle) * std::sin(0.5 * angle);
        // b.z is rounded to 6e-8 beside an exact b.x: relative 4e-7 for the sum of squares.
        CHECK(double(one_minus_cosine(a, b)) == doctest::Approx(exact).epsilon(4e-7));
    }
}

TEST_CASE("a walk of 500 turns gives the same stored digest at every width") {
    PILEUS_EACH_WIDTH(check_digest);
}
