// SPDX-License-Identifier: Apache-2.0
// Sky maps against their definition: what is seen, what is sent, where the directions lie.
// in: small maps -> out: chi-square of directions, powers, radiances against plain double.
// docs/methods.md 3 "Sky map"; docs/scene.md "Sky map".
#include "src/base/digest.h"
#include "tests/support/chi_square.h"
#include "tests/support/render_harness.h"
#include "tests/support/sky_images.h"
#include "tests/support/trace_harness.h"
#include "tests/support/widths.h"

using namespace sky_test;

namespace {

const double kBox[3] = {3, 1, 0.5};
// The grid of directions is 720 x 1440 midpoints of a function with kinks: relative (1/720)^2 / 12
// per kinked cell; 1e-4 is far above and far below any fault.
constexpr double kGridError = 1e-4;

constexpr int kThetaBins = 9, kPhiBins = 12;
std::size_t bin_of(double theta, double phi) {
    const double turn = phi / (2 * kPi64);
    const int i = std::min(int(theta / kPi64 * kThetaBins), kThetaBins - 1);
    const int j = std::min(int((turn - std::floor(turn)) * kPhiBins), kPhiBins - 1);
    return std::size_t(i * kPhiBins + j);
}

/// Draws `samples` directions as the tracer would and counts them in bins of the sphere.
std::vector<std::int64_t> count_draws(const SkyMap& map, std::uint64_t seed, std::int64_t samples) {
    constexpr int kWidth = 4;
    const float face[3] = {float(kBox[1] * kBox[2]), float(kBox[2] * kBox[0]),
                           float(kBox[0] * kBox[1])};
    const Key key = make_key(seed, 5, 0), words = make_key(seed, 6, 0);
    std::vector<std::int64_t> counts(kThetaBins * kPhiBins);
    for (std::int64_t n = 0; n < samples; n += kWidth) {
        const U<kWidth> number = reinterpret<U<kWidth>>(iota<I<kWidth>>()) + std::uint32_t(n);
        // Independent words in place of the even sequence, as chi-square asks.
        const Words<U<kWidth>> w = threefry(words.k0, words.k1, number, U<kWidth>{});
        const auto everyone = (number & 0u) == 0u;
        const MapDraw<F<kWidth>> draw =
            draw_from_map<F<kWidth>>(map.view, face, key, number, w.a, w.b, everyone);
        for (int i = 0; i < kWidth; ++i) {
            const double x = double(lane(draw.to_sky.x, i)), y = double(lane(draw.to_sky.y, i)),
                         z = double(lane(draw.to_sky.z, i));
            ++counts[bin_of(std::acos(std::min(1.0, std::max(-1.0, z))), std::atan2(x, y))];
        }
    }
    return counts;
}

bool check_draws(const char* name, const SkyMap& map, bool ground, std::uint64_t seed) {
    std::vector<double> share(kThetaBins * kPhiBins);
    double total = 0;
    each_direction(ground, [&](double theta, double phi, double omega) {
        const double v = radiance_at(map, theta, phi, 0) * silhouette(kBox, theta, phi) * omega;
        share[bin_of(theta, phi)] += v;
        total += v;
    });
    CHECK(map.power_m2 == doctest::Approx(total).epsilon(kGridError));
    return two_stage_chi_square(name, seed, [&](std::uint64_t s, std::int64_t samples) {
        const std::vector<std::int64_t> counts = count_draws(map, s, samples);
        std::vector<std::int64_t> used;
        std::vector<double> expected;
        for (std::size_t b = 0; b < share.size(); ++b) {
            const double e = share[b] / total * double(samples);
            if (e < 5) {
                CHECK(counts[b] <= (e > 0 ? 30 : 0));  // over 30 where 5 are due: once in 1e13
                continue;
            }
            used.push_back(counts[b]);
            expected.push_back(e);
        }
        return chi_square(used, expected);
    });
}

template <int W>
void check_same_bits() {
    const SkyMap map = sky_map_of(rough_sky(12, 7, true), false, kBox, 33);
    const float face[3] = {0.5f, 1.5f, 3.0f};
    Digest digest;
    for (std::uint32_t n = 0; n < 4096; n += W) {
        const U<W> number = reinterpret<U<W>>(iota<I<W>>()) + n;
        const Words<U<W>> w = threefry(1u, 2u, number, U<W>{});
        const MapDraw<F<W>> draw =
            draw_from_map<F<W>>(map.view, face, {3, 4}, number, w.a, w.b, (number & 0u) == 0u);
        const Vec<F<W>> seen = map_radiance(map.view, draw.to_sky);
        const F<W> share = texel_share(map.view, draw.texel, 2);
        for (int i = 0; i < W; ++i)
            for (const F<W>& v :
                 {draw.to_sky.x, draw.to_sky.y, draw.to_sky.z, seen.x, seen.y, seen.z, share})
                digest.f32(lane(v, i));
    }
    CHECK(digest.value() == 0x3cd715532a177e94ull);
}

}  // namespace

TEST_CASE("sky map: directions are drawn from radiance times silhouette") {
    CHECK(check_draws("full sphere 12 x 7", sky_map_of(rough_sky(12, 7, false), false, kBox), false,
                      1));
    CHECK(check_draws("full sphere, turned", sky_map_of(rough_sky(9, 6, false), false, kBox, 77),
                      false, 2));
    CHECK(check_draws("upper half, even rows", sky_map_of(rough_sky(12, 6, false), true, kBox),
                      true, 3));
    CHECK(check_draws("upper half, odd rows", sky_map_of(rough_sky(5, 7, false), true, kBox), true,
                      4));
    const auto one = [](int, int, int) { return 2.0; };
    CHECK(check_draws("one texel", sky_map_of(sky_image(1, 1, one), false, kBox), false, 5));
    CHECK(check_draws("one texel, upper half", sky_map_of(sky_image(1, 1, one), true, kBox), true,
                      6));
}

TEST_CASE("sky map: the criterion fails for a map that is turned by half a texel") {
    // The opposite of the test above, to show that it can fail.
    SkyMap map = sky_map_of(rough_sky(12, 7, false), false, kBox);
    map.rotation_deg = 15;
    std::vector<double> share(kThetaBins * kPhiBins);
    double total = 0;
    each_direction(false, [&](double theta, double phi, double omega) {
        const double v = radiance_at(map, theta, phi, 0) * silhouette(kBox, theta, phi) * omega;
        share[bin_of(theta, phi)] += v;
        total += v;
    });
    for (double& s : share) s *= double(1 << 20) / total;
    CHECK(chi_square(count_draws(map, 9, 1 << 20), share).p < 1e-6);
}

TEST_CASE("sky map: a constant map has a constant sky's power and light on the ground") {
    const auto two = [](int, int, int) { return 2.0; };
    trace_test::Rig rig = trace_test::make_rig({1, 1, 1}, {kBox[0], kBox[1], kBox[2]}, 1);
    for (int height : {1, 2, 5, 16})
        for (bool ground : {false, true}) {
            const SkyMap map = sky_map_of(sky_image(2 * height, height, two), ground, kBox, 12, 3);
            const Light sky = diffuse_light(rig.medium, ground ? -1 : 0);
            // Quadrature of smooth pieces: 1e-12; the columns' tents miss nothing.
            CHECK(map.power_m2 == doctest::Approx(6 * sky.power_m2).epsilon(1e-10));
            if (ground)
                CHECK(map.ground_irradiance[1] == doctest::Approx(6 * kPi64).epsilon(1e-10));
            CHECK(map.view.planes == 1);
        }
}

TEST_CASE("sky map: every colour sends what the eye sees of it") {
    for (bool ground : {false, true}) {
        const SkyMap map = sky_map_of(rough_sky(12, 7, true), ground, kBox, 200);
        REQUIRE(map.view.planes == 3);
        double flux[3] = {}, level[3] = {};
        each_direction(ground, [&](double theta, double phi, double omega) {
            for (int c = 0; c < 3; ++c) {
                const double v = radiance_at(map, theta, phi, c) * omega;
                flux[c] += v * silhouette(kBox, theta, phi);
                level[c] += v * std::max(std::cos(theta), 0.0);
            }
        });
        trace_test::Rig rig = trace_test::make_rig({1, 1, 1}, {kBox[0], kBox[1], kBox[2]}, 1);
        rig.medium.channels = 3;
        rig.lighting.map = map.view;
        trace_test::add_light(rig, map_light(map));
        for (std::size_t c = 0; c < 3; ++c) {
            if (ground)
                CHECK(map.ground_irradiance[c] == doctest::Approx(level[c]).epsilon(kGridError));
            char name[64];
            std::snprintf(name, sizeof name, "flux of channel %d%s", int(c),
                          ground ? ", upper half" : "");
            trace_test::check_mean(
                name, flux[c],
                [&](int multiple, std::uint64_t seed) {
                    return trace_test::batch_mean(
                        rig, std::uint64_t(100'000 * multiple), seed, [&](const TraceTally& t) {
                            CHECK(trace_test::balance(t.light, c) == 0);
                            return double(t.light.emitted[c]) / double(kPhotonQuanta) /
                                   double(t.photons) * map.power_m2;
                        });
                },
                flux[c] * kGridError);
        }
    }
}

TEST_CASE("sky map: what is seen is the map, bilinear, with its middle in the north") {
    const Image image = rough_sky(12, 7, true);
    for (double rotation : {0.0, 90.0, -33.0}) {
        const SkyMap map = sky_map_of(image, false, kBox, rotation);
        double worst = 0;
        each_direction(false, [&](double theta, double phi, double) {
            const Vec<float> d{float(std::sin(theta) * std::sin(phi)),
                               float(std::sin(theta) * std::cos(phi)), float(std::cos(theta))};
            const Vec<float> seen = map_radiance(map.view, d);
            const float values[3] = {seen.x, seen.y, seen.z};
            for (int c = 0; c < 3; ++c)
                worst =
                    std::max(worst, std::fabs(double(values[c]) - radiance_at(map, theta, phi, c)));
        });
        // Neighbours differ by 6 at most; a direction in single precision is 1e-7 off, near the
        // poles up to 1e-7 / sin(theta) in azimuth: 12 columns x 6 x 1e-7 x 460 / 2 pi.
        CHECK(worst <= 6e-4);
    }
    // Column 6 of 12 begins in the north; the one after it lies to the east of that.
    const auto mark = [](int row, int column, int) { return row == 3 && column == 6 ? 1.0 : 0.0; };
    const SkyMap map = sky_map_of(sky_image(12, 7, mark), false, kBox);
    const double azimuth = 15 * kPi64 / 180;
    const auto seen = [&](double x, double y) {
        return map_radiance(map.view, Vec<float>{float(x), float(y), 0}).x;
    };
    CHECK(seen(std::sin(azimuth), std::cos(azimuth)) == doctest::Approx(1).epsilon(1e-5));
    CHECK(seen(0, 1) == doctest::Approx(0.5).epsilon(1e-5));
    CHECK(seen(-std::sin(azimuth), std::cos(azimuth)) == doctest::Approx(0).epsilon(1e-5));
    CHECK(seen(0, -1) == 0);
}

TEST_CASE("sky map: draws and looks have the same bits at every width") {
    PILEUS_EACH_WIDTH(check_same_bits);
}
