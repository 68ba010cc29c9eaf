// SPDX-License-Identifier: Apache-2.0
// Recipes of particles: how many, where, how they move, and the same bits however they are made.
// in: rows of the table of densities -> out: pass or fail.
// docs/particles.md, "A plume" and "A cumulus"; docs/testing.md, label law
#include <doctest/doctest.h>

#include <algorithm>

#include "src/base/digest.h"
#include "src/io/particles/particles.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/density_row.h"

using namespace pileus;

namespace {

constexpr std::uint64_t kMany = 20000;
constexpr double kRise = 4;

MediumSettings settings() {
    MediumSettings medium;
    medium.box.bounds_m[0] = {-1600, -1500, 900};
    medium.box.bounds_m[1] = {1600, 1500, 2900};
    medium.particles.count = std::int64_t(kMany);
    medium.particles.rise_m_per_s = kRise;
    return medium;
}

void make(const char* name, const MediumSettings& medium, int threads, ParticleSet& set) {
    const DensityRow* row = density_row(name);
    REQUIRE(row != nullptr);
    const Status status = row->make_particles(medium, threads, set);
    REQUIRE_MESSAGE(bool(status), status.message);
}

std::string digest(const ParticleSet& set) {
    Digest digest;
    digest.floats(set.position.span());
    digest.floats(set.radius.span());
    digest.floats(set.density.span());
    digest.floats(set.velocity.span());
    return digest.hex();
}

}  // namespace

TEST_CASE("particle recipes: as many as asked, within the box, the same bits by any threads") {
    int recipes = 0;
    for (const DensityRow* row : density_rows()) {
        if (row->make_particles == nullptr) continue;
        ++recipes;
        CAPTURE(std::string(row->name));
        MediumSettings medium = settings();
        ParticleSet one, three;
        make(row->name, medium, 1, one);
        make(row->name, medium, 3, three);
        CHECK(digest(one) == digest(three));
        CHECK(one.count == kMany);
        CHECK(one.position.size() == 3 * kMany);
        CHECK(one.velocity.size() == 3 * kMany);
        bool within = true, numbered = true, lawful = true;
        for (std::size_t i = 0; i < kMany; ++i) {
            numbered = numbered && one.id[i] == i;
            lawful = lawful && one.radius[i] > 0 && one.density[i] >= 0 && one.density[i] < 1e6f;
            for (std::size_t a = 0; a < 3; ++a) {
                // Places are floats of up to 1600: their rounding.
                const double v = one.origin[int(a)] + double(one.position[3 * i + a]);
                within = within &&
                         v - double(one.radius[i]) >= medium.box.bounds_m[0][int(a)] - 1e-3 &&
                         v + double(one.radius[i]) <= medium.box.bounds_m[1][int(a)] + 1e-3;
            }
        }
        CHECK(within);
        CHECK(numbered);
        CHECK(lawful);
        medium.shape_seed = 3;
        make(row->name, medium, 1, three);
        CHECK(digest(one) != digest(three));
        medium.particles.count = 1;
        make(row->name, medium, 2, three);
        CHECK(three.count == 1);
    }
    CHECK(recipes >= 2);
}

TEST_CASE("particle recipes: a cumulus has a flat base, turrets, and more water above") {
    ParticleSet set;
    const MediumSettings medium = settings();
    make("procedural:particle-cumulus", medium, 1, set);
    const double base = medium.box.bounds_m[0][2], height = medium.box.bounds_m[1][2] - base;
    // Places over squares of the base, 200 m wide, whose lowest particle tells where it is.
    constexpr int kSquares = 16;
    double lowest[kSquares * kSquares], highest[kSquares * kSquares], extinction[2] = {};
    int upper[2] = {}, many[kSquares * kSquares] = {};
    std::fill_n(lowest, kSquares * kSquares, height);
    std::fill_n(highest, kSquares * kSquares, 0.0);
    for (std::size_t i = 0; i < kMany; ++i) {
        const float* p = &set.position[3 * i];
        const double z = set.origin[2] + double(p[2]) - base, r = double(set.radius[i]);
        const int at = std::min(kSquares - 1, int((double(p[0]) + 1600) / 200)) +
                       kSquares * std::min(kSquares - 1, int((double(p[1]) + 1500) / 200));
        lowest[at] = std::min(lowest[at], z - r);
        highest[at] = std::max(highest[at], z + r);
        ++many[at];
        const int half = z > 0.5 * height ? 1 : 0;
        extinction[half] += double(set.density[i]);
        ++upper[half];
    }
    int squares = 0, flat = 0;
    double top = 0, least = height;
    for (int i = 0; i < kSquares * kSquares; ++i) {
        if (many[i] < 30) continue;
        ++squares;
        flat += lowest[i] < 0.02 * height ? 1 : 0;
        top = std::max(top, highest[i]);
        least = std::min(least, highest[i]);
    }
    CAPTURE(squares);
    CAPTURE(flat);
    CHECK(squares > 40);
    // Only heads that lean out beyond the base hang free of it.
    CHECK(flat > 0.85 * squares);
    CHECK(top > 0.9 * height);
    CHECK(least < 0.5 * top);
    REQUIRE(std::min(upper[0], upper[1]) > 100);
    CHECK(extinction[1] / upper[1] > 1.3 * extinction[0] / upper[0]);
}

TEST_CASE("particle recipes: bubbles of a cumulus rise, turn over, and do not spread") {
    ParticleSet set;
    make("procedural:particle-cumulus", settings(), 1, set);
    double mean[3] = {}, spread = 0, reach = 0;
    int sinking = 0, fast = 0;
    for (std::size_t i = 0; i < kMany; ++i) {
        const float *v = &set.velocity[3 * i], *p = &set.position[3 * i];
        for (std::size_t a = 0; a < 3; ++a) mean[a] += double(v[a]) / kMany;
        spread += double(v[0]) * double(p[0]) + double(v[1]) * double(p[1]);
        reach += double(p[0]) * double(p[0]) + double(p[1]) * double(p[1]);
        sinking += double(v[2]) < 0 ? 1 : 0;
        fast += double(v[2]) > kRise ? 1 : 0;
    }
    // A vortex as dense everywhere has no mean; its rim, which sinks, holds more of the particles.
    CAPTURE(mean[2]);
    CHECK(mean[2] > 0.6 * kRise);
    CHECK(mean[2] < kRise);
    // Turns without a mean: noise of 20 000, speeds of kRise, and bubbles that the base cuts.
    CHECK(std::max(mean[0] * mean[0], mean[1] * mean[1]) < 0.05 * 0.05 * kRise * kRise);
    // The rims of the largest alone.
    CHECK(sinking > 0.01 * kMany);
    CHECK(fast > 0.2 * kMany);
    // Divergence over the whole: within a tenth of rise over height.
    CAPTURE(spread / reach);
    CHECK(spread / reach < 0.1 * kRise / 2000);
    CHECK(spread / reach > -0.1 * kRise / 2000);
}

TEST_CASE("particle recipes: each has its own keys") {
    for (const DensityRow* row : density_rows()) {
        if (row->make_particles == nullptr) continue;
        const std::string name = row->name, table = row->table;
        CAPTURE(name);
        const std::string text =
            "[camera]\nposition_m = [0, -9, 0]\ntarget_m = [0, 0, 0]\n[[medium]]\n"
            "extinction_per_m = 1\nbounds_m = [[0, 0, 0], [1, 1, 1]]\ndensity = \"" +
            name + "\"\n";
        Scene scene;
        REQUIRE(read_scene_text(text + table + " = { particles = 77, rise_m_per_s = 2 }\n",
                                "s.toml", "", {}, scene));
        CHECK(scene.media[0].particles.count == 77);
        CHECK(scene.media[0].particles.rise_m_per_s == 2);
        REQUIRE(read_scene_text(text, "s.toml", "", {}, scene));
        CHECK(scene.media[0].particles.count == 100000);
    }
}
