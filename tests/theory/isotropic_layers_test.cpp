// SPDX-License-Identifier: Apache-2.0
// The solver of isotropic layers is itself right: another solver, printed numbers, laws.
// in: layers -> out: rows of differences.
// docs/validation.md; van de Hulst 1980 vol. 1 p. 256.
#include "tests/theory/isotropic_layers.h"

#include <doctest/doctest.h>

#include <cstdio>

#include "tests/theory/adding_doubling.h"

using namespace isotropic;

TEST_CASE("isotropic layers: exponential integrals") {
    // Abramowitz & Stegun, tables 5.1 and 5.4, ten and seven digits.
    CHECK(std::fabs(e1(0.5) - 0.5597735948) <= 1e-10);
    CHECK(std::fabs(e1(1.0) - 0.2193839344) <= 1e-10);
    CHECK(std::fabs(e1(2.0) - 0.0489005107) <= 1e-10);
    CHECK(std::fabs(e2(0.5) - 0.3266439) <= 5e-8);
    CHECK(std::fabs(e3(0.5) - 0.2216044) <= 5e-8);
    CHECK(e2(0) == 1);
    CHECK(e3(0) == 0.5);
}

TEST_CASE("isotropic layers: the other solver's shares") {
    const double slabs[][3] = {{1, 0.99, 0.5}, {0.03125, 1, 0.1}, {0.5, 0.8, 0.3}};
    for (const auto& s : slabs) {
        const auto other = adding_doubling::solve({s[0], s[1], 0}, {s[2]}, 64)[0];
        const Field field({{s[0], s[1]}}, {1 / s[2], s[2], 0}, 300);
        const double r = field.flux(0, true);
        const double t = field.flux(s[0], false) + std::exp(-s[0] / s[2]);
        std::printf("tau %g albedo %g mu0 %g: R %.7f (%.7f) T %.7f (%.7f)\n", s[0], s[1], s[2], r,
                    other.reflected, t, other.transmitted);
        // 300 cells leave 1e-5, as twice as many show below.
        CHECK(std::fabs(r - other.reflected) <= 2e-5);
        CHECK(std::fabs(t - other.transmitted) <= 2e-5);
    }
}

TEST_CASE("isotropic layers: two layers of one albedo are one, and more cells change little") {
    const Light sky{0, 0.5, 1}, beam{3, 0.3, 0};
    for (const Light& light : {sky, beam}) {
        const Field one({{1, 0.9}}, light, 300), two({{0.4, 0.9}, {0.6, 0.9}}, light, 150);
        for (double t : {0.0, 0.4, 1.0})
            for (double mu : {-0.9, -0.1, 0.1, 0.9}) {
                // A cell's middle stands for all of it: 1e-5 of the light, relative.
                CHECK(std::fabs(one.radiance(t, mu) - two.radiance(t, mu)) <= 3e-5);
                CHECK(std::fabs(one.mean_radiance(t) - two.mean_radiance(t)) <= 3e-5);
            }
    }
}

TEST_CASE("isotropic layers: what is absorbed is the loss of flux") {
    // d(flux down - flux up)/dt = -4 pi (1 - albedo) J; by differences of the fluxes.
    const Field field({{0.25, 0.5}, {0.25, 0.3}}, {0, 1, 1}, 200);
    const double pi = std::acos(-1.0), step = 1e-3;
    for (double t : {0.1, 0.2, 0.3, 0.4}) {
        const auto net = [&](double at) { return field.flux(at, false) - field.flux(at, true); };
        const double lost = (net(t - step) - net(t + step)) / (2 * step);
        const double absorbed = 4 * pi * (t < 0.25 ? 0.5 : 0.7) * field.mean_radiance(t);
        CHECK(std::fabs(lost / absorbed - 1) <= 1e-4);
    }
}
