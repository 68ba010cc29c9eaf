// SPDX-License-Identifier: Apache-2.0
// Procedural skies: coverage as asked, none at 0, wind, levels of detail, hard settings.
// in: settings -> out: pass or fail.
#include <cmath>
#include <limits>

#include "kernels_cpu/procedural/sky_field.h"
#include "tests/sky/sky_rig.h"

using namespace sky_test;

namespace {

/// Share of straight columns whose density reaches one half somewhere.
double covered(const Rig& rig, int columns) {
    const SkyParams& k = rig.params();
    Numbers r;
    r.state = 99;
    int hits = 0;
    for (int i = 0; i < columns; ++i) {
        const float x = r.in(0, 100000), y = r.in(0, 100000);
        bool hit = false;
        for (int j = 0; j < 32 && !hit; ++j) {
            const float z = k.low_m + k.height_m * (float(j) + 0.5f) / 32;
            hit = sky_density(k, Vec<float>{x, y, z}, 0.0f) >= 0.5f;
        }
        hits += hit ? 1 : 0;
    }
    return double(hits) / columns;
}

double mean_density(const Rig& rig, float width, int places) {
    const SkyParams& k = rig.params();
    Numbers r;
    double sum = 0;
    for (int i = 0; i < places; ++i) {
        const Vec<float> p{r.in(0, 50000), r.in(0, 50000), r.in(1000, 2500)};
        sum += double(sky_density(k, p, width));
    }
    return sum / places;
}

}  // namespace

TEST_CASE("the coverage that is asked for is there") {
    for (double asked : {0.1, 0.25, 0.5, 0.75, 0.9}) {
        SkySettings s = small_sky();
        s.coverage = asked;
        // 8192 columns set the threshold and 6000 others measure it. Columns share lumps, but both
        // lots are strewn over the whole tile: 4 binomial deviations of both, 0.034 at one half.
        const double tolerance = 4 * std::sqrt(asked * (1 - asked) * (1 / 8192.0 + 1 / 6000.0));
        for (const bool turned : {false, true})
            CHECK(covered(Rig(s, {0, 0, 0}, turned), 6000) ==
                  doctest::Approx(asked).epsilon(tolerance / asked));
    }
}

TEST_CASE("coverage 0 is nothing at all, coverage 1 everywhere something") {
    SkySettings s = small_sky();
    s.coverage = 0;
    const Rig none(s);
    CHECK(mean_density(none, 0, 20000) == 0);
    CHECK(mean_density(none, 800, 20000) == 0);
    CHECK(sky_ahead(none.params(), {0, 0, 1500}, {1, 0, 0}, 0.0f).bound == 0);
    s.coverage = 1;
    CHECK(covered(Rig(s), 3000) > 0.999);
}

TEST_CASE("levels of detail keep the mean density") {
    SkySettings s = small_sky();
    s.coverage = 0.4;
    const Rig rig(s);
    const double fine = mean_density(rig, 0, 60000);
    // 4 deviations of two means over 60000 places are 1.5 %; the widened ramp keeps the first two
    // moments of what is lost, not its shape: allow 15 %.
    for (float width : {200.0f, 400.0f, 800.0f, 1600.0f})
        CHECK(mean_density(rig, width, 60000) == doctest::Approx(fine).epsilon(0.15));
    CHECK(fine > 0.05);
}

TEST_CASE("wind moves the clouds, and a long wind by the rest of a tile") {
    SkySettings s = small_sky();
    s.blend = 1;
    const Rig still(s);
    s.wind_m_per_s = {8, -4}, s.time_s = 16;
    const Rig later(s);
    s.time_s = 16 + 4096.0 * 1e6;  // a whole number of tiles
    const Rig much_later(s);
    Numbers r;
    int cloudy = 0;
    for (int i = 0; i < 2000; ++i) {
        const float x = std::floor(r.in(0, 8192)), y = std::floor(r.in(0, 8192)),
                    z = r.in(1000, 2500);
        const float now = sky_density(still.params(), {x, y, z}, 0.0f);
        cloudy += now > 0 ? 1 : 0;
        // Offsets are rounded to 6e-8 of a tile, a quarter of a millimetre.
        CHECK(sky_density(later.params(), {x + 128, y - 64, z}, 0.0f) ==
              doctest::Approx(now).epsilon(1e-4).scale(1));
        CHECK(sky_density(much_later.params(), {x + 128, y - 64, z}, 0.0f) ==
              doctest::Approx(now).epsilon(1e-4).scale(1));
    }
    CHECK(cloudy > 100);
}

TEST_CASE("turned tiles hold the noise of unturned ones, at turned places") {
    const Double3 low{300, -700, 0};
    const Rig turned(small_sky(), low, true), straight(small_sky());
    const double turns[2][2] = {{0.8, 0.6}, {12.0 / 13, -5.0 / 13}};
    Numbers r;
    for (int i = 0; i < 2000; ++i) {
        const Vec<float> p{r.in(0, 4000), r.in(0, 4000), r.in(1000, 2500)};
        for (int n = 0; n < 2; ++n) {
            const double x = double(p.x) + low[0], y = double(p.y) + low[1];
            const Vec<float> q{float(turns[n][0] * x + turns[n][1] * y),
                               float(turns[n][0] * y - turns[n][1] * x), p.z};
            const NoiseView& a = n == 0 ? turned.params().perlin : turned.params().worley;
            const NoiseView& b = n == 0 ? straight.params().perlin : straight.params().worley;
            // Places round to half a millimetre of texels of 94 m or more.
            CHECK(read_noise(a, p, 0.0f).value ==
                  doctest::Approx(read_noise(b, q, 0.0f).value).epsilon(1e-3));
        }
    }
}

TEST_CASE("a lone noise follows the thresholds") {
    SkySettings s = small_sky();
    s.blend = 1;
    const Rig rig(s);
    const SkyParams& k = rig.params();
    Numbers r;
    for (int i = 0; i < 2000; ++i) {
        const Vec<float> p{r.in(0, 9000), r.in(0, 9000), r.in(1000, 2500)};
        const double noise = double(read_noise(k.perlin, p, 0.0f).value);
        const double t = std::fmin(1, std::fmax(0, (noise - 0.5) / 0.2));
        CHECK(sky_density(k, p, 0.0f) ==
              doctest::Approx(t * t * (3 - 2 * t)).epsilon(1e-4).scale(1));
    }
}

TEST_CASE("hard settings stay finite, within 0 and 1, and bounded") {
    const float inf = std::numeric_limits<float>::infinity();
    for (double tile : {1e-3, 1.0, 1e9})
        for (double thick : {1.0, 1e4})
            for (double radius : {0.0, 6.371e6})
                for (double time : {0.0, 1e9}) {
                    SkySettings s = small_sky();
                    s.size = 16, s.perlin.cells = s.worley.cells = 2;
                    s.perlin.tile_m = s.worley.tile_m = tile;
                    s.base_m = 0, s.top_m = thick, s.planet_radius_m = radius;
                    s.wind_m_per_s = {100, 33}, s.time_s = time;
                    const Rig rig(s, {-1e6, 3e5, 0}, radius > 0);
                    Numbers r;
                    for (int i = 0; i < 300; ++i) {
                        const float reach = i % 3 == 0 ? 1e7f : 1e3f;
                        const Vec<float> p{r.in(-reach, reach), r.in(-reach, reach),
                                           r.in(-10, 1e4)};
                        const Vec<float> d = normalized(Vec<float>{r.in(-1, 1), 0.5f, r.in(-1, 1)});
                        const float width = i % 2 == 0 ? 0.0f : r.in(0, 1e6);
                        const float v = sky_density(rig.params(), p, width);
                        CHECK((v >= 0 && v <= 1));
                        const NoiseBound<float> b = sky_ahead(rig.params(), p, d, width);
                        CHECK(b.bound >= v * 0.999f);
                        CHECK((b.rest >= 0 && b.rest < inf));
                        const Segment<float> way = clip_to_sky(rig.params(), p, d);
                        CHECK((way.enter >= 0 && way.leave >= way.enter));
                    }
                }
}
