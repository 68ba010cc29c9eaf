// SPDX-License-Identifier: Apache-2.0
// The blender of billboards against closed forms.
// in: few spheres seen by a small camera -> out: transmittance, colour and half depth.
// docs/methods.md 3, each image frame, step 5.
#include <cmath>

#include "tests/support/blend_harness.h"

using namespace blend_harness;

TEST_CASE("blend: one sphere through its centre and beside it") {
    Spheres s;
    s.add(0, 100, 0, 10, 0.05f, 3);
    Pixel p = through(s);
    CHECK(p.transmittance == doctest::Approx(std::exp(-1.0)).epsilon(2e-7));  // two roundings
    CHECK(p.colour == doctest::Approx(3 * (1 - std::exp(-1.0))).epsilon(4e-7));

    // Half of the light is lost after ln 2 / extinction; the sphere begins at 90 m.
    CHECK(p.half_depth == doctest::Approx(90 + std::log(2.0) / 0.05).epsilon(2e-7));

    // A triangle 6, 8, 10 leaves half a chord of 8; the squares are exact in float.
    s.x[0] = 6;
    p = through(s);
    CHECK(p.transmittance == doctest::Approx(std::exp(-0.8)).epsilon(2e-7));
    s.x[0] = 10.5f;
    CHECK(through(s).transmittance == 1.0);
    CHECK(through(s).half_depth == double(kInfinity));
}

TEST_CASE("blend: far away the distance from the axis does not cancel") {
    // At 16384 m a difference of squares would be wrong by 16 m^2, more than the radius's square.
    Spheres s;
    s.add(0.75f, 16384, 0, 1.25f, 0.5f, 1);
    CHECK(through(s).transmittance == doctest::Approx(std::exp(-1.0)).epsilon(2e-7));
}

TEST_CASE("blend: the nearer sphere covers the farther, ties go by index") {
    Spheres s;
    s.add(0, 130, 0, 10, 0.03f, 8);
    s.add(0, 100, 0, 10, 0.05f, 1);
    const double a = 1 - std::exp(-1.0), b = 1 - std::exp(-0.6);
    CHECK(through(s).colour == doctest::Approx(a + (1 - a) * b * 8).epsilon(4e-7));
    s.y[0] = 100;
    CHECK(through(s).colour == doctest::Approx(b * 8 + (1 - b) * a).epsilon(4e-7));
    s.x[0] = 6, s.x[1] = -6;
    const double c = 1 - std::exp(-0.8), d = 1 - std::exp(-0.48);
    CHECK(through(s).colour == doctest::Approx(d * 8 + (1 - d) * c).epsilon(4e-7));
}

TEST_CASE("blend: a solid cuts the chord") {
    Spheres s;
    s.add(0, 100, 0, 10, 0.05f, 1);
    CHECK(through(s, 80).transmittance == 1.0);
    CHECK(through(s, 100).transmittance == doctest::Approx(std::exp(-0.5)).epsilon(2e-7));
    CHECK(through(s, 95).transmittance == doctest::Approx(std::exp(-0.25)).epsilon(2e-7));
    CHECK(through(s, 120).transmittance == through(s).transmittance);
    CHECK(through(s, 100).half_depth == double(kInfinity));
    CHECK(through(s, 0).transmittance == 1.0);
}

TEST_CASE("blend: a camera inside sees what lies ahead, and nothing behind it counts") {
    Spheres s;
    s.add(0, 5, 0, 10, 0.1f, 1);
    CHECK(through(s).transmittance == doctest::Approx(std::exp(-1.5)).epsilon(2e-7));
    CHECK(through(s).half_depth == doctest::Approx(std::log(2.0) / 0.1).epsilon(4e-7));
    s.y[0] = -5;
    CHECK(through(s).transmittance == doctest::Approx(std::exp(-0.5)).epsilon(2e-7));
    s.y[0] = -10;
    CHECK(through(s).transmittance == 1.0);
    s.y[0] = -100;
    CHECK(through(s).transmittance == 1.0);
    CHECK(through(s).colour == 0.0);
}

TEST_CASE("blend: orthographic rays are parallel, depth is along the view") {
    Spheres s;
    s.add(6, 100, 8, 12.5f, 0.04f, 2);  // 10 m off the axis: half a chord of 7.5
    const Pixel p = through(s, kInfinity, look_flat(1, 1, 30));
    CHECK(p.transmittance == doctest::Approx(std::exp(-0.6)).epsilon(2e-7));
    CHECK(p.colour == doctest::Approx(2 * (1 - std::exp(-0.6))).epsilon(4e-7));

    // The farther along the view lies behind, though its centre is nearer to the camera.
    s.add(0, 101, 0, 10, 0.05f, 1);
    const double a = 1 - std::exp(-0.6), b = 1 - std::exp(-1.0);
    CHECK(through(s, kInfinity, look_flat(1, 1, 30)).colour ==
          doctest::Approx(a * 2 + (1 - a) * b).epsilon(4e-7));
    s.y[0] = 0;
    s.y[1] = -50;
    CHECK(through(s, kInfinity, look_flat(1, 1, 30)).transmittance ==
          doctest::Approx(std::exp(-0.3)).epsilon(2e-7));
}

TEST_CASE("blend: no spheres leave an empty image") {
    BillboardImage out;
    REQUIRE(bool(Spheres(3).render(look_north(37, 5), out)));
    CHECK(out.transmittance.size() == 37 * 5);
    CHECK(out.colour.size() == 3 * 37 * 5);
    for (float t : out.transmittance.span()) CHECK(t == 1.0f);
    for (float c : out.colour.span()) CHECK(c == 0.0f);
    for (float z : out.half_depth.span()) CHECK(z == kInfinity);
}

TEST_CASE("blend: 100000 thin layers in one place are one thick layer") {
    // Each layer rounds T by at most 2^-25 T, in no preferred direction: a random walk of
    // sqrt(1e5) 2^-25 = 1e-5; five times that is allowed. The light is the rest to rounding.
    Spheres s;
    for (int i = 0; i < 100000; ++i) s.add(0, 100, 0, 10, 2e-6f, 1);
    const Pixel p = through(s);
    CHECK(p.transmittance == doctest::Approx(std::exp(-4.0)).epsilon(5e-5));
    CHECK(p.colour == doctest::Approx(1 - std::exp(-4.0)).epsilon(5e-5));
}

TEST_CASE("blend: opaque and nearly empty spheres") {
    Spheres s;
    s.add(0, 100, 0, 10, 1e6f, 4);
    CHECK(through(s).transmittance == 0.0);
    CHECK(through(s).colour == 4.0);
    CHECK(through(s).half_depth == doctest::Approx(90).epsilon(1e-7));

    // The taken share keeps its relative accuracy where 1 - T has lost its digits.
    s.extinction[0] = 1e-6f;
    CHECK(through(s).colour == doctest::Approx(4 * -std::expm1(-2e-5)).epsilon(3e-7));
    s.extinction[0] = 1e-12f;
    CHECK(through(s).colour == doctest::Approx(4 * -std::expm1(-2e-11)).epsilon(3e-7));
    s.extinction[0] = 0;
    CHECK(through(s).colour == 0.0);
}

TEST_CASE("blend: a pixel below the cut takes no more light") {
    Spheres s;
    s.add(0, 100, 0, 10, 0.5f, 1);  // leaves e^-10 = 4.5e-5, under the cut of 1e-4
    const double colour = through(s).colour;
    s.add(0, 150, 0, 10, 0.5f, 1e6f);
    CHECK(through(s).colour == colour);
    s.extinction[0] = 0.45f;  // leaves e^-9 = 1.2e-4, above it
    CHECK(through(s).colour > 100.0);
}
