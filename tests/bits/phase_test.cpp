// SPDX-License-Identifier: Apache-2.0
// Phase functions: samples, densities and moments against long double references.
// in: kernels_cpu/media/phase.h -> out: largest errors, exact cases, quadrature; no statistics.
// docs/testing.md S1-S4, S6, S7.
#include "kernels_cpu/media/phase.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "kernels_cpu/core/rng.h"
#include "src/base/digest.h"
#include "tests/support/phase_reference.h"
#include "tests/support/quadrature.h"
#include "tests/support/widths.h"

using namespace pileus;

namespace {

constexpr float kEveryG[] = {
    0.0f, 1e-8f, 1e-7f, 1e-6f, 1e-5f, 1e-4f, 1e-3f,  0.01f,   0.1f,     0.3f,      0.5f,
    0.6f, 0.75f, 0.85f, 0.9f,  0.95f, 0.99f, 0.999f, 0.9999f, 0.99999f, 0.999999f, 1.0f - 0x1p-23f};

// What hg_sample states; 4.2e-7 measured over a third of all draws at 18 g of both signs.
constexpr double kHgError = 4.5e-7;

/// Every g of the list with both signs.
std::vector<float> every_g() {
    std::vector<float> list;
    for (const float g : kEveryG) list.push_back(g), list.push_back(-g);
    return list;
}

/// Draws of uniform_open: the 64 smallest, the 64 largest, and 16384 between.
std::vector<float> some_draws() {
    std::vector<float> list;
    for (std::uint32_t k = 0; k < 64; ++k) {
        list.push_back(uniform_open(k << 9));
        list.push_back(uniform_open(~(k << 9)));
    }
    for (std::uint32_t k = 0; k < 16384; ++k) list.push_back(uniform_open(k * 0x40000u + 0x1ff00u));
    return list;
}

double relative(double value, Real exact) { return std::fabs(double(Real(value) / exact - 1)); }

/// The larger of two errors; a NaN counts as 1e9.
double worse(double a, double b) { return b <= a ? a : b == b ? b : 1e9; }

struct SampleErrors {
    double absolute = 0, relative = 0, sine = 0;
    std::int64_t outside = 0;
};

SampleErrors sample_errors(float g) {
    SampleErrors e;
    for (const float u : some_draws()) {
        const Turn<float> turn = hg_sample(g, u);
        const Angle exact = hg_angle(Real(g), Real(u));
        const double x = double(turn.one_minus_cos);
        e.absolute = worse(e.absolute, std::fabs(double(Real(x) - exact.minus)));
        e.relative = worse(e.relative, relative(x, exact.minus));
        const Real sine = std::sqrt(exact.minus * exact.plus);
        e.sine = worse(e.sine, relative(double(turn.sine), sine));
        e.outside += !(x >= 0 && x <= 2) || !(turn.sine >= 0 && turn.sine <= 1);
    }
    return e;
}

/// Mean of 1 - cos over every one of the 2^23 draws of uniform_open.
template <int W>
double mean_over_every_draw(float g, std::int64_t& outside) {
    double sum = 0;
    for (std::uint32_t k = 0; k < (1u << 23); k += W) {
        const U<W> word = (iota<U<W>>() + k) << 9;
        const Turn<F<W>> turn = hg_sample(all<F<W>>(g), uniform_open(word));
        const F<W> x = turn.one_minus_cos;
        const auto inside = (x >= 0.0f) & (x <= 2.0f) & (turn.sine >= 0.0f) & (turn.sine <= 1.0f);
        outside += any(lnot(inside));
        for (int i = 0; i < W; ++i) sum += double(lane(x, i));
    }
    return sum / (1u << 23);
}

std::vector<PhaseParams> every_phase() {
    std::vector<PhaseParams> list{rayleigh(), two_lobe(0.85f, -0.3f, 0.9f),
                                  two_lobe(0.6f, -0.6f, 0.5f), two_lobe(0.9f, 0.2f, 0.25f)};
    for (const float g : {0.0f, 1e-6f, -1e-6f, 1e-3f, -1e-3f, 0.3f, -0.3f, 0.6f, -0.6f, 0.85f,
                          -0.85f, 0.99f, 0.999f, 0.9999f})
        list.push_back(henyey_greenstein(g));
    return list;
}

/// 2 pi times the integral of density * P_l over 1 - cos in [0, 2].
double moment_by_quadrature(const PhaseParams& p, int l) {
    static const Quadrature q = gauss_legendre(16);
    return 2 * double(kPiReal) * integrate_graded(q, 0.0, 2.0, 40, [&](double x) {
               return double(phase_density(p, float(x))) * legendre(l, 1 - x);
           });
}

template <int W>
std::uint64_t digest_of_phases() {
    Digest digest;
    for (const PhaseParams& p : every_phase())
        for (std::uint32_t i = 0; i < 1024; i += W) {
            const auto w = threefry(2u, 2u, iota<U<W>>() + i, all<U<W>>(0u));
            const Turn<F<W>> turn = phase_sample(p, uniform_open(w.a));
            const F<W> density = phase_density(p, uniform(w.b) * 2.0f);
            for (int k = 0; k < W; ++k) {
                digest.f32(lane(turn.one_minus_cos, k));
                digest.f32(lane(turn.sine, k));
                digest.f32(lane(density, k));
            }
        }
    return digest.value();
}

template <int W>
void check_digest() {
    CHECK(digest_of_phases<W>() == 0xbc9b3df2f2c4b883ull);
}

}  // namespace

TEST_CASE("the references agree: inverse, share and the textbooks' formula") {
    for (const float g : {0.01f, 0.3f, -0.3f, 0.85f, -0.85f, 0.99f, -0.99f})
        for (int k = 1; k < 1000; ++k) {
            const Real u = Real(k) / 1000;
            const Angle a = hg_angle(Real(g), u);
            // Double on some machines: 1e-16 / (2 g) for the textbooks, a few 1e-16 otherwise.
            CHECK(std::fabs(double(a.minus + a.plus - 2)) <= 1e-14);
            CHECK(std::fabs(double(hg_share(Real(g), a) - u)) <= 1e-14);
            CHECK(std::fabs(double(hg_cosine_textbook(Real(g), u) - (a.plus - 1))) <= 1e-12);
        }
}

TEST_CASE("S1-S3: HG samples within the stated 4.5e-7 for every |g| <= 1 - 1e-7, both signs") {
    SampleErrors all_g;
    for (const float g : every_g()) {
        const SampleErrors e = sample_errors(g);
        CHECK_MESSAGE(e.absolute <= kHgError, "g = ", g);
        CHECK_MESSAGE(e.relative <= kHgError, "g = ", g);
        CHECK_MESSAGE(e.sine <= kHgError, "g = ", g);
        CHECK_MESSAGE(e.outside == 0, "g = ", g);
        all_g.absolute = worse(all_g.absolute, e.absolute);
        all_g.relative = worse(all_g.relative, e.relative);
        all_g.sine = worse(all_g.sine, e.sine);
    }
    std::printf("HG samples: 1-cos within %.3g, relative %.3g; sine relative %.3g\n",
                all_g.absolute, all_g.relative, all_g.sine);
}

TEST_CASE("S1, S4: g = 0 and g = +-1 are exact") {
    for (const float u : some_draws()) {
        CHECK(hg_sample(0.0f, u).one_minus_cos == 2.0f * u);
        CHECK(hg_sample(-0.0f, u).one_minus_cos == 2.0f * u);
        CHECK(hg_sample(1.0f, u).one_minus_cos == 0.0f);
        CHECK(hg_sample(-1.0f, u).one_minus_cos == 2.0f);
        CHECK(hg_sample(1.0f, u).sine == 0.0f);
        CHECK(hg_sample(-1.0f, u).sine == 0.0f);
    }
    for (const float x : {0.0f, 0.5f, 1.0f, 2.0f}) {
        CHECK(hg_density(0.0f, x) == kInvFourPi);
        CHECK(hg_density(1.0f, x) == 0.0f);
        CHECK(hg_density(-1.0f, x) == 0.0f);
    }
}

TEST_CASE("S6: g -> -g with u -> 1-u swaps 1-cos and 1+cos, density alike") {
    std::int64_t wrong = 0;
    for (const float g : every_g())
        for (const float u : some_draws()) {
            const Turn<float> a = hg_sample(g, u), b = hg_sample(-g, 1.0f - u);
            const float x = a.one_minus_cos, y = b.one_minus_cos;
            wrong += a.sine != b.sine || (x <= 1.0f ? y != 2.0f - x : x != 2.0f - y);
            // 2 - far is exact: far lies in [1, 2].
            const float far = 2.0f - u;
            wrong += hg_density(g, far) != hg_density(-g, 2.0f - far);
        }
    CHECK(wrong == 0);
}

TEST_CASE("S2: the mean of 1-cos over every draw is 1-g; never outside [0, 2]") {
    int counter = 0;
    for (const float g :
         {0.0f, 1e-7f, -1e-7f, 1e-3f, -1e-3f, -0.3f, -0.6f, 0.85f, -0.99f, 0.9999f}) {
        // One g in five where the machine is emulated: every draw counts in a mean.
        if (kThin > 1 && counter++ % 5 != 3) continue;
        std::int64_t outside = 0;
        const double mean = mean_over_every_draw<4>(g, outside);
        std::printf("HG g %-10g mean 1-cos %.9f, error %.2g\n", double(g), mean,
                    mean - (1 - double(g)));
        // Midpoints of 2^23 cells: below 1e-7; sample errors do not all share a sign.
        CHECK(std::fabs(mean - (1 - double(g))) <= 2e-7);
        CHECK(outside == 0);
    }
}

TEST_CASE("HG density within 1e-6 of the reference, relative") {
    double worst = 0;
    for (const float g : every_g())
        for (const float u : some_draws())
            for (const float x : {2.0f * u, 2.0f - 2.0f * u, u * u * u, u * 1e-6f}) {
                const Real exact = hg_density_reference(Real(g), from_minus(Real(x)));
                worst = worse(worst, relative(double(hg_density(g, x)), exact));
            }
    std::printf("HG density: relative error %.3g\n", worst);
    CHECK(worst <= 1e-6);
}

TEST_CASE("Rayleigh: samples within 3e-7 of the inverse, density of the reference") {
    double sample = 0, sine = 0, density = 0;
    std::int64_t outside = 0;
    for (const float u : some_draws()) {
        // Cardano's solution of c^3 + 3c = 2b, b = 2 - 4u.
        const Real b = 2 - 4 * Real(u), r = std::sqrt(b * b + 1);
        const Real k = std::cbrt(std::fabs(b) + r), c = (b < 0 ? -1 : 1) * (k - 1 / k);
        const Turn<float> turn = rayleigh_sample(u);
        sample = worse(sample, std::fabs(double(Real(turn.one_minus_cos) - (1 - c))));
        const double s2 = double(turn.sine) * double(turn.sine);
        sine = worse(sine, std::fabs(double(Real(s2) - (1 - c * c))));
        const float x = 2.0f * u;
        const Real exact = phase_density_reference(rayleigh(), from_minus(Real(x)));
        density = worse(density, relative(double(phase_density(rayleigh(), x)), exact));
        outside += !(turn.one_minus_cos >= 0 && turn.one_minus_cos <= 2);
    }
    std::printf("Rayleigh: 1-cos within %.3g, sine^2 %.3g, density %.3g\n", sample, sine, density);
    CHECK(sample <= 3e-7);
    CHECK(sine <= 6e-7);
    CHECK(density <= 3e-7);
    CHECK(outside == 0);
}

TEST_CASE("S7: density integrates to 1 and its Legendre moments are phase_moment") {
    double worst = 0;
    for (const PhaseParams& p : every_phase())
        for (int l = 0; l < 8; ++l) {
            const double error = moment_by_quadrature(p, l) - double(phase_moment(p, l));
            worst = worse(worst, std::fabs(error));
            // Rounding of the density and of x, 1e-6 at most, averaged over the sphere.
            CHECK_MESSAGE(std::fabs(error) <= 1e-6, "type ", p.type, " g ", p.g1, " degree ", l);
        }
    std::printf("moments 0..7 of every phase within %.3g\n", worst);
}

TEST_CASE("phase_peak bounds the density everywhere and is reached") {
    for (const PhaseParams& p : every_phase()) {
        const float peak = phase_peak(p);
        float largest = 0;
        for (int k = 0; k <= 65536; ++k) {
            const float x = float(k) * 0x1p-15f;
            for (const float at : {x, x * x * 1e-4f, 2.0f - x * x * 1e-4f})
                largest = max_(largest, phase_density(p, at));
        }
        CHECK(largest == peak);
    }
}

TEST_CASE("two lobes: u below the weight draws the first, stretched; weights 0 and 1 draw one") {
    for (const float u : some_draws()) {
        const Turn<float> one = phase_sample(two_lobe(0.85f, -0.3f, 1.0f), u);
        const Turn<float> two = phase_sample(two_lobe(0.85f, -0.3f, 0.0f), u);
        const Turn<float> half = phase_sample(two_lobe(0.85f, -0.3f, 0.5f), u);
        CHECK(one.one_minus_cos == hg_sample(0.85f, u).one_minus_cos);
        CHECK(two.one_minus_cos == hg_sample(-0.3f, u).one_minus_cos);
        const Turn<float> lobe =
            u < 0.5f ? hg_sample(0.85f, 2.0f * u) : hg_sample(-0.3f, 2.0f * u - 1.0f);
        CHECK(half.one_minus_cos == lobe.one_minus_cos);
    }
    // A draw on the weight itself must not become 0.
    CHECK(phase_sample(two_lobe(0.85f, 0.5f, 0.75f), 0.75f).one_minus_cos > 0.0f);
}

TEST_CASE("every phase gives the same stored digest at every width") {
    PILEUS_EACH_WIDTH(check_digest);
}
