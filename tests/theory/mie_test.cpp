// SPDX-License-Identifier: Apache-2.0
// Lorenz-Mie spheres against published numbers, and the stored tables of clouds against them.
// in: lab/mie/mie.h, src/world/phase/mie_data.h -> out: efficiencies, mean cosines,
// densities. docs/phase.md, "Mie"; Bohren and Huffman 1983, appendix A; Wiscombe 1979, table of
// test cases.
#include "lab/mie/mie.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>

#include "src/world/phase/medium_phase.h"
#include "src/world/phase/mie_data.h"
#include "tests/support/long_tests.h"

using namespace pileus;

namespace {

/// Mean cosine of the function between the nodes, in full precision.
double mean_cosine_of(const PhaseStore& store) {
    double moment[2];
    phase_table_moments(store.table[0], 2, moment);
    return moment[1];
}

/// Computes the cloud of table `i` again and compares every stored number.
void check_table(int i) {
    const std::vector<double> angles = mie_table_angles();
    REQUIRE(angles.size() == std::size_t(kMieAngles));
    MieCloud cloud;
    cloud.effective_radius_um = double(kMieRadius[i]);
    const MieResult result = mie_cloud(cloud, angles);
    std::int64_t wrong = 0;
    for (int k = 0; k < kMieAngles; ++k) {
        wrong += int(angles[std::size_t(k)] * 100 + 0.5) != int(kMieAngle[k]);
        // Another compiler may round a sum otherwise: one unit of the stored form is allowed.
        const int stored = int(mie_stored(result.density[std::size_t(k)]));
        wrong += std::abs(stored - int(kMieDensity[i][k])) > 1;
    }
    CHECK(wrong == 0);
    CHECK(result.extinction_efficiency == doctest::Approx(double(kMieExtinction[i])).epsilon(1e-5));
    PhaseStore store;
    REQUIRE(make_cloud_phase(cloud.effective_radius_um, store));
    const double g = mean_cosine_of(store);
    std::printf("cloud of %g um: Q %.4f, mean cosine of the spheres %.5f, of the table %.5f\n",
                cloud.effective_radius_um, result.extinction_efficiency, result.mean_cosine, g);
    // Lines between the nodes lie above a curve that bends upwards, by 0.6 % at most.
    CHECK(std::fabs(g - result.mean_cosine) <= 2e-4);
}

}  // namespace

TEST_CASE("Mie: published efficiencies and mean cosines of single spheres") {
    double q = 0, g = 0;
    // Bohren and Huffman's example: 0.525 um, 1.55, 0.6328 um in vacuum.
    mie_sphere(2 * 3.14159265358979324 * 0.525 / 0.6328, 1.55, q, g);
    CHECK(q == doctest::Approx(3.10543).epsilon(2e-6));
    CHECK(g == doctest::Approx(0.63314).epsilon(1e-5));
    // Wiscombe's cases of index 1.5: x = 10 and 1000 (van de Hulst's limits beside them).
    mie_sphere(10, 1.5, q, g);
    CHECK(q == doctest::Approx(2.8820).epsilon(2e-5));
    CHECK(g == doctest::Approx(0.742913).epsilon(2e-6));
    // Rayleigh: Q = 8/3 x^4 ((m^2-1)/(m^2+2))^2, terms of x^6 left out; no preferred direction.
    mie_sphere(0.01, 1.333, q, g);
    const double m2 = 1.333 * 1.333, k = (m2 - 1) / (m2 + 2);
    CHECK(q == doctest::Approx(8.0 / 3 * 1e-8 * k * k).epsilon(1e-4));
    CHECK(std::fabs(g) <= 1e-4);
    // Large spheres: the extinction paradox, Q -> 2 with 2 x^(-2/3) above it.
    mie_sphere(1e4, 1.333, q, g);
    CHECK(std::fabs(q - 2) <= 4e-3 + 2 * std::pow(1e4, -2.0 / 3));
}

TEST_CASE("Mie: the table of the smallest droplets is made again; all of them in the long form") {
    check_table(0);
    for (int i = 1; i < kMieRadii && long_tests(); ++i) check_table(i);
}

TEST_CASE("clouds: mean cosine, peak, bow and glory grow as they should from 4 to 20 um") {
    double before = 0;
    float peak = 0;
    for (double r = 4; r <= 20; r += 0.5) {
        PhaseStore store;
        REQUIRE(make_cloud_phase(r, store));
        const double g = mean_cosine_of(store);
        CHECK(g > before);
        CHECK(store.table[0].peak > peak);
        before = g;
        peak = store.table[0].peak;
        const auto at = [&](double deg) {
            const float x = float(1 - std::cos(deg * 0.0174532925199433));
            return double(phase_density(store.params(), x));
        };
        // A dark side, a fog bow above its surroundings, a glory above the ring around it.
        CHECK(at(100) < 0.005);
        CHECK(at(140) > 2 * at(120));
        CHECK(at(140) > 1.2 * at(165));
        CHECK(at(180) > at(176));
    }
    // By another program, written apart: g and P(0).
    const double known[][3] = {{4, 0.8422, 98},
                               {5.77, 0.8529, 201},
                               {7, 0.8576, 293},
                               {10, 0.8642, 592},
                               {12.68, 0.8672, 947}};
    for (const auto& row : known) {
        PhaseStore store;
        REQUIRE(make_cloud_phase(row[0], store));
        std::printf("cloud of %5g um: mean cosine %.4f (%.4f), peak %.1f (%.0f)\n", row[0],
                    mean_cosine_of(store), row[1], double(store.table[0].peak), row[2]);
        CHECK(std::fabs(mean_cosine_of(store) - row[1]) <= 1e-3);
        // Between two radii the peak, which grows as their square, is mixed in a straight line.
        CHECK(double(store.table[0].peak) == doctest::Approx(row[2]).epsilon(0.02));
    }
}
