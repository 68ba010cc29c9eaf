// SPDX-License-Identifier: Apache-2.0
// Children that stand for particles of a file: mass, spread, sameness.
// in: small files, `replicate` -> out: particles whose sums are compared.
// docs/particles.md, "Replication"
#include <doctest/doctest.h>

#include <cmath>

#include "src/io/particles/placed_particles.h"
#include "tests/io/temp_folder.h"

using namespace pileus;

namespace {

ParticleSet read(const std::string& rows, int times, double radius = 0.5, double share = 1) {
    const test::TempFolder folder;
    folder.put("p.csv", rows);
    MediumSettings medium;
    medium.particles.replicate = times;
    medium.particles.replicate_radius = radius;
    medium.particles.share = share;
    ParticleSet set;
    const Status status = read_placed_particles(medium, folder.path("p.csv"), set);
    REQUIRE_MESSAGE(bool(status), status.message);
    return set;
}

double mass(const ParticleSet& set) {
    double sum = 0;
    for (std::size_t i = 0; i < set.count; ++i)
        sum += double(set.density[i]) * std::pow(double(set.radius[i]), 3);
    return sum;
}

}  // namespace

TEST_CASE("replicated particles keep their mass, middle and spread") {
    const std::string row = "x y z radius density id\n10 20 30 4 0.7 5\n";
    const ParticleSet parent = read(row, 1);
    for (const double radius : {0.2, 0.5, 0.9, 1.0}) {
        const int times = 10000;
        const ParticleSet all = read(row, times, radius);
        REQUIRE(all.count == std::uint64_t(times));
        CHECK(mass(all) == doctest::Approx(mass(parent)).epsilon(1e-6));
        double mean[3] = {}, square[3] = {};
        const double far = 4 * (std::sqrt(1 - radius * radius) + 1e-6);
        for (std::size_t i = 0; i < all.count; ++i) {
            double distance = 0;
            for (int a = 0; a < 3; ++a) {
                const double d = all.origin[a] + double(all.position[3 * i + std::size_t(a)]) -
                                 (parent.origin[a] + double(parent.position[std::size_t(a)]));
                mean[a] += d / times;
                square[a] += d * d / times;
                distance += d * d;
                CHECK_UNARY(all.origin[a] + double(all.position[3 * i + std::size_t(a)]) -
                                double(all.radius[i]) >=
                            all.low[a] - 1e-5);
            }
            CHECK_UNARY(std::sqrt(distance) <= far);
        }
        for (int a = 0; a < 3; ++a) {
            // The places' and the children's own, a ninth of the radius squared along an axis.
            const double own = square[a] + radius * radius * 16 / 9;
            CHECK(std::fabs(mean[a]) < 4.5 * 4 / 3 / std::sqrt(times));
            CHECK(own == doctest::Approx(16.0 / 9).epsilon(0.06));
        }
    }
}

TEST_CASE("children depend on their parent alone") {
    const std::string head = "x y z radius density id\n", bare = "x y z radius density\n";
    const std::string a = "1 2 3 0.5 0.1", b = "1.5 2 3 0.7 0.3", c = "1 2.5 3 0.6 0.2";
    // Shares keep parents, not children: 0.999 keeps these.
    for (const bool named : {true, false}) {
        const auto text = [&](const std::string& row, const char* id) {
            return row + (named ? id : "") + "\n";
        };
        const std::string h = named ? head : bare;
        const ParticleSet one = read(h + text(a, " 7") + text(b, " 8") + text(c, " 9"), 6);
        const ParticleSet two = read(h + text(c, " 9") + text(a, " 7") + text(b, " 8"), 6);
        REQUIRE(one.count == 18);
        REQUIRE(two.count == 18);
        for (std::size_t i = 0; i < 18; ++i) {
            const std::size_t j = (i + 6) % 18;
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(one.position[3 * i + k] == two.position[3 * j + k]);
            CHECK(one.density[i] == two.density[j]);
            if (named) CHECK(one.id[i] == two.id[j]);
        }
        // Fewer are the first of many, but for what each weighs.
        const ParticleSet more = read(h + text(a, " 7"), 9), few = read(h + text(a, " 7"), 4);
        for (std::size_t i = 0; i < 12; ++i) CHECK(more.position[i] == few.position[i]);
    }
}

TEST_CASE("children have all of their parent's columns; too many are a limit") {
    const std::string rows =
        "x y z radius density vx vy vz red green blue emission_red emission_green emission_blue\n"
        "1 2 3 0.5 0.1 4 5 6 0.1 0.2 0.3 7 8 9\n";
    const ParticleSet set = read(rows, 3);
    REQUIRE(set.count == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(set.velocity[3 * i + 1] == 5);
        CHECK(set.colour[3 * i + 2] == 0.3f);
        CHECK(set.emission[3 * i] == 7);
        CHECK(set.radius[i] == 0.25f);
    }
    CHECK(read(rows, 1).count == 1);
    std::string many = "x y z radius\n";
    for (int i = 0; i < 20001; ++i) many += std::to_string(i) + " 0 0 1\n";
    const test::TempFolder folder;
    folder.put("p.csv", many);
    MediumSettings medium;
    medium.particles.replicate = 10000;
    ParticleSet large;
    const Status status = read_placed_particles(medium, folder.path("p.csv"), large);
    CHECK(status.message.find("replicate: too many particles, 20001 times 10000, allowed: at "
                              "most 200000000 in all") != std::string::npos);
}
