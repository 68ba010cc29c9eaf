// SPDX-License-Identifier: Apache-2.0
// The layer between two spheres: altitudes and ways in float against long double, far and near.
// in: places and rays -> out: pass or fail.
#include <cmath>

#include "kernels_cpu/procedural/sky_layer.h"
#include "tests/sky/sky_rig.h"

using namespace sky_test;

namespace {

constexpr long double kEarth = 6.371e6L;

SkyParams layer(float low, float height, bool bent) {
    SkyParams k{};
    k.low_m = low, k.height_m = height, k.inverse_m = 1 / height;
    k.curvature_per_m = bent ? float(1 / kEarth) : 0.0f;
    return k;
}

long double altitude_of(const Vec<float>& p) {
    const long double x = (long double)p.x, y = (long double)p.y, z = (long double)p.z + kEarth;
    return std::sqrt(x * x + y * y + z * z) - kEarth;
}

Vec<float> along(const Vec<float>& p, const Vec<float>& d, double t) {
    return {float(double(p.x) + t * double(d.x)), float(double(p.y) + t * double(d.y)),
            float(double(p.z) + t * double(d.z))};
}

}  // namespace

TEST_CASE("S45 altitudes above a planet keep centimetres where radii keep half a metre") {
    const SkyParams k = layer(1000, 2000, true);
    Numbers r;
    double worst_near = 0, worst_far = 0;
    for (int i = 0; i < 20000; ++i) {
        const double reach = std::pow(10.0, 2 + 5 * r.next());
        const Vec<float> p{r.in(-reach, reach), r.in(-reach, reach), r.in(-2000, 15000)};
        const double error = std::fabs(double((long double)altitude(k, p) - altitude_of(p)));
        if (reach < 2e5)
            worst_near = std::fmax(worst_near, error);
        else
            worst_far = std::fmax(worst_far, error / reach);
    }
    MESSAGE("largest error within 200 km: " << worst_near << " m");
    CHECK(worst_near < 0.02);  // a few units in the last place of 16 km
    CHECK(worst_far < 1e-6);   // of the distance, beyond
    CHECK(altitude(k, Vec<float>{0, 0, 0}) == 0.0f);
    CHECK(altitude(layer(0, 1, false), Vec<float>{3, 4, 5}) == 5.0f);
}

TEST_CASE("rays meet the layer where its spheres are") {
    const SkyParams k = layer(1000, 2000, true);
    Numbers r;
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
        const float height = i % 3 == 0 ? 2.0f : i % 3 == 1 ? 1700.0f : r.in(0, 20000);
        const Vec<float> p{r.in(-3000, 3000), r.in(-3000, 3000), height};
        const Vec<float> d =
            normalized(Vec<float>{r.in(-1, 1), r.in(-1, 1), r.in(-1, 1) * r.in(0, 0.3)});
        const Segment<float> s = clip_to_sky(k, p, d);
        CHECK(s.enter >= 0);
        CHECK(s.leave >= s.enter);
        if (!(s.leave > s.enter)) continue;
        ++met;
        const double from = double(altitude_of(along(p, d, double(s.enter))));
        const double to = double(altitude_of(along(p, d, double(s.leave))));
        // A float tells places along a ray to 6e-8 of its length: 600 km give centimetres, times
        // the ray's slope at most.
        const double tolerance = 0.05 + 2e-6 * double(s.leave);
        const double here = double(altitude_of(p));
        if (s.enter > 0) CHECK(std::fabs(from - (here < 1000 ? 1000 : 3000)) < tolerance);
        CHECK(std::fmin(std::fabs(to - 3000), std::fabs(to)) < tolerance);
    }
    CHECK(met > 10000);
}

TEST_CASE("from 1e7 m a ray down meets the top and ends on the ground") {
    const SkyParams k = layer(1000, 2000, true);
    const Segment<float> s = clip_to_sky(k, Vec<float>{0, 0, 1e7f}, Vec<float>{0, 0, -1});
    CHECK(s.enter == doctest::Approx(1e7 - 3000).epsilon(1e-6));
    CHECK(s.leave == doctest::Approx(1e7).epsilon(1e-6));
    const Segment<float> past = clip_to_sky(k, Vec<float>{0, 0, 1e7f}, Vec<float>{1, 0, 0});
    CHECK(past.leave == past.enter);
    const Segment<float> away = clip_to_sky(k, Vec<float>{0, 0, 1e7f}, Vec<float>{0, 0, 1});
    CHECK(away.leave == away.enter);
}

TEST_CASE("what lies outside the layer is passed over, and never more") {
    for (bool bent : {false, true}) {
        const SkyParams k = layer(1000, 500, bent);
        Numbers r;
        for (int i = 0; i < 5000; ++i) {
            const Vec<float> p{r.in(-1e5, 1e5), r.in(-1e5, 1e5),
                               i % 2 == 0 ? r.in(1500, 9000) : r.in(-500, 1000)};
            const Vec<float> d = normalized(Vec<float>{r.in(-1, 1), r.in(-1, 1), r.in(-0.1, 0.1)});
            const float h = altitude(k, p);
            if (h >= 1000 && h <= 1500) continue;
            const double way = std::fmin(double(way_outside(k, p, d, h)), 2e5);
            for (int s = 0; s < 10; ++s) {
                const Vec<float> q = along(p, d, way * s / 10 * 0.999);
                const double at = bent ? double(altitude_of(q)) : double(q.z);
                CHECK((at < 1000.1 || at > 1499.9));
            }
        }
    }
}

TEST_CASE("a level ray from the ground meets the base at the horizon of the shell") {
    const SkyParams k = layer(1000, 2000, true);
    const Segment<float> s = clip_to_sky(k, Vec<float>{0, 0, 0}, Vec<float>{0, 1, 0});
    CHECK(s.enter == doctest::Approx(std::sqrt(2 * 6.371e6 * 1000 + 1e6)).epsilon(1e-5));
    CHECK(s.leave == doctest::Approx(std::sqrt(2 * 6.371e6 * 3000 + 9e6)).epsilon(1e-5));
}
