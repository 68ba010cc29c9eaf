// SPDX-License-Identifier: Apache-2.0
// Real spherical harmonics: orthonormal, bounded, in the stated order and sign.
// in: kernels_cpu/core/sh.h -> out: quadrature over the sphere, addition theorem, moments of HG.
// docs/methods.md 2.
#include "kernels_cpu/core/sh.h"

#include <doctest/doctest.h>

#include <cstdio>

#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/media/phase.h"
#include "src/base/digest.h"
#include "tests/support/quadrature.h"
#include "tests/support/widths.h"

using namespace pileus;

namespace {

constexpr double kPiDouble = 3.14159265358979324;
constexpr int kValues = kMaxBands * kMaxBands;

// At most eight float products and sums in a row: 8 * 2 * 6e-8 of the largest |y|, and the
// direction itself is rounded (6e-8 times a slope of at most l = 7).
constexpr double kRelative = 2e-6;

double largest(int l) { return std::sqrt((2 * l + 1) / (4 * kPiDouble)); }

/// Directions without order: unit vectors from the counter-based generator, in float.
Vec<float> direction(std::uint32_t i) {
    const Words<std::uint32_t> w = threefry(3u, 4u, i, 0u);
    const float z = 2.0f * uniform_open(w.a) - 1.0f, r = sqrt_(1.0f - z * z);
    const SinCos<float> turn = sincos_turns(uniform(w.b));
    return normalized(Vec<float>{r * turn.cosine, r * turn.sine, z});
}

template <int W>
std::uint64_t digest_of_values() {
    Digest digest;
    for (std::uint32_t i = 0; i < 1024; i += W) {
        F<W> x{}, y{}, z{}, out[kValues];
        for (int k = 0; k < W; ++k) {
            const Vec<float> d = direction(i + std::uint32_t(k));
            set_lane(x, k, d.x), set_lane(y, k, d.y), set_lane(z, k, d.z);
        }
        sh_eval<kMaxBands>(x, y, z, out);
        for (int k = 0; k < W; ++k)
            for (const F<W>& v : out) digest.f32(lane(v, k));
    }
    return digest.value();
}

template <int W>
void check_digest() {
    CHECK(digest_of_values<W>() == 0xd8dd0ce8ee632529ull);
}

/// Largest difference between `Bands` bands and the same values of all bands.
template <int Bands>
void check_fewer_bands() {
    std::int64_t wrong = 0;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const Vec<float> d = direction(i);
        float every[kValues], some[Bands * Bands];
        sh_eval<kMaxBands>(d.x, d.y, d.z, every);
        sh_eval<Bands>(d.x, d.y, d.z, some);
        for (int k = 0; k < Bands * Bands; ++k) wrong += every[k] != some[k];
    }
    CHECK(wrong == 0);
}

/// Projection of HG(g) around `axis` on every y_i; `nodes` in cos(theta) graded to the peak.
void project(float g, const Vec<float>& axis, double* out) {
    const Quadrature q = gauss_legendre(48);
    constexpr int kTurns = 32;  // exact for |m| < 32
    for (int i = 0; i < kValues; ++i) out[i] = 0;
    for (std::size_t n = 0; n < q.node.size(); ++n) {
        const double x = 1 + q.node[n];  // 1 - cos(theta)
        const double weight =
            q.weight[n] * 2 * kPiDouble / kTurns * double(hg_density(g, float(x)));
        for (int k = 0; k < kTurns; ++k) {
            const SinCos<float> phi = sincos_turns((float(k) + 0.5f) / kTurns);
            const float sine = float(std::sqrt(x * (2 - x)));
            const Vec<float> d = turned(axis, float(1 - x), sine, phi.cosine, phi.sine);
            float y[kValues];
            sh_eval<kMaxBands>(d.x, d.y, d.z, y);
            for (int i = 0; i < kValues; ++i) out[i] += weight * double(y[i]);
        }
    }
}

}  // namespace

TEST_CASE("orthonormal to 8 bands over the sphere") {
    // Degree 14 at most: 12 nodes and 16 turns are exact, so only the float values differ.
    const Quadrature q = gauss_legendre(12);
    constexpr int kTurns = 16;
    std::vector<double> gram(kValues * kValues);
    for (std::size_t n = 0; n < q.node.size(); ++n)
        for (int k = 0; k < kTurns; ++k) {
            const double phi = 2 * kPiDouble * (k + 0.25) / kTurns, z = q.node[n];
            const double r = std::sqrt(1 - z * z);
            float y[kValues];
            sh_eval<kMaxBands>(float(r * std::cos(phi)), float(r * std::sin(phi)), float(z), y);
            const double weight = q.weight[n] * 2 * kPiDouble / kTurns;
            for (int i = 0; i < kValues; ++i)
                for (int j = 0; j < kValues; ++j)
                    gram[std::size_t(i * kValues + j)] += weight * double(y[i]) * double(y[j]);
        }
    double worst = 0;
    for (int i = 0; i < kValues; ++i)
        for (int j = 0; j < kValues; ++j)
            worst = std::fmax(worst, std::fabs(gram[std::size_t(i * kValues + j)] - (i == j)));
    std::printf("sh: largest error of the Gram matrix %.3g\n", worst);
    CHECK(worst <= kRelative);
}

TEST_CASE("addition theorem: squares of a band sum to (2l+1)/4pi; each value is bounded") {
    double worst = 0, over = 0;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const Vec<float> d = direction(i);
        float y[kValues];
        sh_eval<kMaxBands>(d.x, d.y, d.z, y);
        for (int l = 0; l < kMaxBands; ++l) {
            double sum = 0;
            for (int m = -l; m <= l; ++m) {
                const double v = double(y[l * (l + 1) + m]);
                sum += v * v;
                over = std::fmax(over, std::fabs(v) / largest(l) - 1);
            }
            worst = std::fmax(worst, std::fabs(sum / (largest(l) * largest(l)) - 1));
        }
    }
    std::printf("sh: addition theorem within %.3g, |y| over its bound by %.3g\n", worst, over);
    // The sum is quadratic: twice the relative error of a value.
    CHECK(worst <= 2 * kRelative);
    CHECK(over <= 1e-6);
}

TEST_CASE("the bound |y| <= sqrt((2l+1)/4pi) (1 + 1e-6) holds at the poles and axes, too") {
    for (const float s : {1.0f, -1.0f})
        for (int axis = 0; axis < 3; ++axis) {
            float y[kValues];
            sh_eval<kMaxBands>(axis == 0 ? s : 0.0f, axis == 1 ? s : 0.0f, axis == 2 ? s : 0.0f, y);
            for (int l = 0; l < kMaxBands; ++l)
                for (int m = -l; m <= l; ++m)
                    CHECK(std::fabs(double(y[l * (l + 1) + m])) <= largest(l) * (1 + 1e-6));
        }
}

TEST_CASE("bands 0, 1 and 2 are the written formulas, in order") {
    const double one = std::sqrt(3 / (4 * kPiDouble)), two = std::sqrt(15 / (4 * kPiDouble));
    for (std::uint32_t i = 0; i < 200; ++i) {
        const Vec<float> d = direction(i);
        const double x = double(d.x), y = double(d.y), z = double(d.z);
        const double expected[9] = {std::sqrt(1 / (4 * kPiDouble)),
                                    one * y,
                                    one * z,
                                    one * x,
                                    two * x * y,
                                    two * y * z,
                                    std::sqrt(5 / (16 * kPiDouble)) * (3 * z * z - 1),
                                    two * x * z,
                                    0.5 * two * (x * x - y * y)};
        float out[9];
        sh_eval<3>(d.x, d.y, d.z, out);
        for (int k = 0; k < 9; ++k) CHECK(std::fabs(double(out[k]) - expected[k]) <= kRelative);
    }
}

TEST_CASE("fewer bands are the first values of more") {
    check_fewer_bands<1>(), check_fewer_bands<2>(), check_fewer_bands<4>(), check_fewer_bands<5>();
}

TEST_CASE("HG(g) around any axis projects to g^l y_lm(axis)") {
    double worst = 0;
    for (const float g : {0.0f, 0.3f, -0.3f, 0.6f, -0.6f})
        for (std::uint32_t i = 0; i < 8; ++i) {
            const Vec<float> axis = direction(100 + i);
            double got[kValues];
            project(g, axis, got);
            float y[kValues];
            sh_eval<kMaxBands>(axis.x, axis.y, axis.z, y);
            for (int l = 0; l < kMaxBands; ++l)
                for (int m = -l; m <= l; ++m) {
                    const int at = l * (l + 1) + m;
                    const PhaseParams p{kPhaseHg, g, 0.0f, 1.0f};
                    const double expected = double(phase_moment(p, l)) * double(y[at]);
                    worst = std::fmax(worst, std::fabs(got[at] - expected));
                }
        }
    std::printf("sh: projection of HG on g^l within %.3g\n", worst);
    // 48 nodes leave 0.6^89 of the peak; what remains is the rounding of float values, densities
    // and directions, each 2e-7 of values up to 1.1.
    CHECK(worst <= kRelative);
}

TEST_CASE("sh_eval gives the same stored digest at every width") {
    PILEUS_EACH_WIDTH(check_digest);
}
