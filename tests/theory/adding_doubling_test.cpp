// SPDX-License-Identifier: Apache-2.0
// The solver by adding and doubling is itself right: published numbers, laws, convergence.
// in: slabs -> out: rows of differences.
// docs/validation.md; van de Hulst 1980 vol. 1 p. 256 and vol. 2 table 35; Chandrasekhar 1960.
#include "tests/theory/adding_doubling.h"

#include <doctest/doctest.h>

#include <cstdio>

using namespace adding_doubling;

namespace {

/// Largest |a - b| over R and T.
double difference(const Fluxes& a, const Fluxes& b) {
    return std::fmax(std::fabs(a.reflected - b.reflected),
                     std::fabs(a.transmitted - b.transmitted));
}

/// H(mu) of isotropic scattering by iteration of its integral equation on Gauss nodes:
/// 1/H = sqrt(1 - a) + a/2 * integral of x H(x) / (mu + x).
double chandrasekhar_h(double albedo, double mu) {
    std::vector<double> x, w;
    gauss(64, x, w);
    std::vector<double> h(x.size(), 1.0);
    const auto next = [&](double m) {
        double sum = 0;
        for (std::size_t j = 0; j < x.size(); ++j) sum += w[j] * x[j] * h[j] / (m + x[j]);
        return 1 / (std::sqrt(1 - albedo) + 0.5 * albedo * sum);
    };
    for (int step = 0; step < 2000; ++step) {
        std::vector<double> better(h.size());
        for (std::size_t i = 0; i < h.size(); ++i) better[i] = 0.5 * (h[i] + next(x[i]));
        h = better;
    }
    return next(mu);
}

}  // namespace

TEST_CASE("adding and doubling: van de Hulst's printed numbers") {
    // Five digits are printed, so each is known to half a unit of the fifth.
    const Fluxes a = solve({2, 0.9, 0.75}, {1}, 32)[0], b = solve({1, 0.99, 0}, {0.5}, 32)[0];
    std::printf("tau 2 g 0.75 albedo 0.9: R %.7f T %.7f; tau 1 isotropic 0.99: R %.7f T %.7f\n",
                a.reflected, a.transmitted, b.reflected, b.transmitted);
    CHECK(std::fabs(a.reflected - 0.09739) <= 5e-6);
    CHECK(std::fabs(a.transmitted - 0.66096) <= 5e-6);
    CHECK(std::fabs(b.reflected - 0.48652) <= 5e-6);
    CHECK(std::fabs(b.transmitted - 0.49163) <= 5e-6);
}

TEST_CASE("adding and doubling: half spaces follow Chandrasekhar's H function") {
    for (double albedo : {0.5, 0.9, 0.99})
        for (double mu0 : {1.0, 0.5}) {
            const double exact = 1 - chandrasekhar_h(albedo, mu0) * std::sqrt(1 - albedo);
            const double r = solve({256, albedo, 0}, {mu0}, 32)[0].reflected;
            std::printf("half space albedo %g mu0 %g: R %.8f, by H %.8f\n", albedo, mu0, r, exact);
            // Layers of 2^-20 in the diamond scheme and 64-point integrals: 10^-7 is left.
            CHECK(std::fabs(r - exact) <= 2e-7);
        }
}

TEST_CASE("adding and doubling: a white slab loses nothing") {
    for (double g : {0.0, 0.85, -0.5})
        for (double tau : {0.1, 4.0, 64.0})
            for (const Fluxes& f : solve({tau, 1, g}, {0.1, 0.5, 1}, 32))
                // Rounding, 10^-16 in each of 2^26 thin layers and a few in each; measured 4e-8.
                CHECK(std::fabs(f.reflected + f.transmitted - 1) <= 1e-7);
}

TEST_CASE("adding and doubling: two directions may change places") {
    // I(i) = sum r_ij I_j with r_ij = R(i, j) w_j mu_j ... so r_ij mu_i / w_j is symmetric.
    const Operators o = operators({3, 0.97, 0.7}, {}, 24);
    const std::size_t n = o.mu.size();
    for (const Matrix* m : {&o.reflect, &o.transmit})
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const double there = (*m)[i * n + j] * o.mu[i] / o.weight[j];
                const double back = (*m)[j * n + i] * o.mu[j] / o.weight[i];
                CHECK(std::fabs(there - back) <= 1e-8 * std::fmax(1.0, std::fabs(there)));
            }
}

TEST_CASE("adding and doubling: more streams change nothing that counts") {
    const double slabs[][4] = {{2, 0.9, 0.75, 1}, {16, 0.999, 0.85, 0.5}, {1, 1, 0.9, 0.2}};
    for (const auto& s : slabs) {
        const Slab slab{s[0], s[1], s[2]};
        const double change = difference(solve(slab, {s[3]}, 48)[0], solve(slab, {s[3]}, 64)[0]);
        std::printf("tau %g albedo %g g %g mu0 %g: 48 and 64 streams differ by %.1e\n", s[0], s[1],
                    s[2], s[3], change);
        CHECK(change <= 2e-6);
    }
}

TEST_CASE("adding and doubling: a slab in closed form, thin and dark") {
    // Single scattering of isotropic light: R = a/2 * integral of (1 - e^{-t(1/m0+1/m)}) m/(m+m0);
    // the second order is under albedo^2 tau.
    const double tau = 1e-3, albedo = 1e-3, mu0 = 0.5;
    std::vector<double> x, w;
    gauss(64, x, w);
    double r = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        r +=
            0.5 * albedo * w[i] * x[i] / (x[i] + mu0) * (1 - std::exp(-tau * (1 / mu0 + 1 / x[i])));
    CHECK(std::fabs(solve({tau, albedo, 0}, {mu0}, 64)[0].reflected - r) <= albedo * albedo * tau);
}
