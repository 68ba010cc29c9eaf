// SPDX-License-Identifier: Apache-2.0
// Particles on a grid and back: what they hold is kept, whatever their order.
// in: particles -> out: pass or fail.
// docs/particles.md, "On a grid"; docs/testing.md, label io
#include "src/io/volumes/particle_volume.h"

#include <doctest/doctest.h>

#include "tests/io/temp_folder.h"

using namespace pileus;

namespace {

/// Particles within a box, radii and densities over `decades` orders of magnitude.
void make(std::size_t count, double size, double radius, int decades, std::uint32_t turn,
          ParticleSet& set) {
    std::string text = "x y z radius density\n";
    for (std::size_t n = 0; n < count; ++n) {
        const std::uint32_t i = std::uint32_t((n + turn) % count);
        const auto draw = [&](std::uint32_t k) {
            std::uint32_t v = (i * 8 + k) * 2654435761u;
            v ^= v >> 15;
            v *= 2246822519u;
            return double(v >> 8) / 0x1p24;
        };
        double scale = 1;
        for (int d = int(draw(4) * decades); d > 0; --d) scale *= 0.1;
        char row[160];
        (void)std::snprintf(row, sizeof row, "%.9g %.9g %.9g %.9g %.9g\n", size * draw(0),
                            size * draw(1), size * draw(2), radius * (0.5 + draw(3)), scale);
        text += row;
    }
    ParticleReading reading;
    REQUIRE(decode_particles("p", ".csv", {text.data(), text.size()}, reading, set));
    REQUIRE(place_particles("p", ParticleSettings{}, set));
}

double held_by(const ParticleSet& set) {
    double sum = 0;
    for (std::size_t i = 0; i < set.count; ++i)
        sum += double(set.density[i]) * kBallMass * double(set.radius[i]) * double(set.radius[i]) *
               double(set.radius[i]);
    return sum;
}

double held_by(const Volume& v) {
    double sum = 0, cell = 1;
    for (const float d : v.density.span()) sum += double(d);
    for (int a = 0; a < 3; ++a)
        cell *= (v.bounds_m[1][a] - v.bounds_m[0][a]) / v.size[std::size_t(a)];
    return sum * cell;
}

}  // namespace

TEST_CASE("particles on a grid: their integral is kept on any cells") {
    ParticleSet set;
    make(500, 100, 8, 12, 0, set);
    for (const std::array<int, 3>& size :
         {std::array<int, 3>{1, 1, 1}, {40, 3, 17}, {5, 5, 5}, particle_cells(set)}) {
        CAPTURE(size[0]);
        Volume v;
        REQUIRE(grid_particles(set, size, 2, v));
        // Each value is a float: 6e-8 of itself.
        CHECK(held_by(v) == doctest::Approx(held_by(set)).epsilon(1e-7));
    }
}

TEST_CASE("particles on a grid: another order, the same bits") {
    ParticleSet a, b;
    make(400, 50, 5, 6, 0, a);
    make(400, 50, 5, 6, 123, b);
    CHECK(particle_cells(a) == particle_cells(b));
    Volume va, vb;
    REQUIRE(grid_particles(a, {20, 20, 20}, 1, va));
    REQUIRE(grid_particles(b, {20, 20, 20}, 7, vb));
    std::size_t other = 0;
    for (std::size_t i = 0; i < va.density.size(); ++i) other += va.density[i] != vb.density[i];
    CHECK(other == 0);
}

TEST_CASE("particles on a grid: the value in a particle is its own") {
    // One particle over many cells: between cell means and the density at their middles lies the
    // second derivative, below (cell / radius)^2.
    ParticleSet set;
    const std::string text = "x y z radius density\n3 4 5 2 0.5\n";
    REQUIRE(decode_particles("p", ".csv", {text.data(), text.size()}, {}, set));
    REQUIRE(place_particles("p", {}, set));
    Volume v;
    REQUIRE(grid_particles(set, {41, 41, 41}, 2, v));
    CHECK(v.bounds_m[0] == Double3(1, 2, 3));
    CHECK(v.bounds_m[1] == Double3(5, 6, 7));
    const auto at = [&](int x, int y, int z) {
        return double(v.density[std::size_t((z * 41 + y) * 41 + x)]);
    };
    const double h = 4.0 / 41 / 2;
    CHECK(at(20, 20, 20) == doctest::Approx(0.5).epsilon(2 * h * h));
    // Half way out: (1 - r^2)^2 with r = 10 cells of 4/41 over 2.
    const double r = 10 * 4.0 / 41 / 2, left = 1 - r * r;
    CHECK(at(30, 20, 20) == doctest::Approx(0.5 * left * left).epsilon(4 * h * h));
    CHECK(at(0, 0, 0) == 0);
}

TEST_CASE("particles on a grid: none, coincident ones, and ones smaller than a sample") {
    ParticleSet none;
    Volume v;
    REQUIRE(grid_particles(none, particle_cells(none), 2, v));
    CHECK(held_by(v) == 0);
    ParticleSet same;
    std::string text = "x y z radius density\n";
    for (int i = 0; i < 1000; ++i) text += "7 7 7 1 1\n";
    REQUIRE(decode_particles("p", ".csv", {text.data(), text.size()}, {}, same));
    REQUIRE(place_particles("p", {}, same));
    REQUIRE(grid_particles(same, particle_cells(same), 2, v));
    CHECK(held_by(v) == doctest::Approx(1000 * kBallMass).epsilon(1e-7));
    ParticleSet tiny;
    text = "x y z radius density\n0 0 0 1e-3 5\n100 100 100 1e-3 5\n";
    REQUIRE(decode_particles("p", ".csv", {text.data(), text.size()}, {}, tiny));
    REQUIRE(place_particles("p", {}, tiny));
    REQUIRE(grid_particles(tiny, {10, 10, 10}, 2, v));
    CHECK(held_by(v) == doctest::Approx(10 * kBallMass * 1e-9).epsilon(1e-6));
    CHECK(v.density[0] > 0);
    CHECK(v.density[999] > 0);
}

TEST_CASE("particles on a grid and back: what each cell holds") {
    ParticleSet set, back;
    make(200, 60, 10, 3, 0, set);
    Volume v;
    REQUIRE(grid_particles(set, {12, 9, 15}, 2, v));
    REQUIRE(particles_of_grid("v", v, back));
    CHECK(back.count > 100);
    CHECK(held_by(back) == doctest::Approx(held_by(v)).epsilon(1e-6));
    Volume lost;
    lost.size = {1, 1, 1};
    REQUIRE(lost.density.resize(1, "d"));
    CHECK(!particles_of_grid("v", lost, back));
}
