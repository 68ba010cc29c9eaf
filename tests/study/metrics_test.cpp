// SPDX-License-Identifier: Apache-2.0
// Every figure of a comparison against an answer known beforehand.
// in: pictures made by hand, pictures of known noise -> out: pass or fail.
// docs/compare.md, "Figures"
#include "lab/compare/metrics.h"

#include <algorithm>
#include <cstdio>
#include <initializer_list>
#include <limits>

#include "src/base/digest.h"
#include "tests/study/pictures.h"

using namespace pileus;
using test::make_picture;

namespace {

const std::vector<std::string> kRgba = {"R", "G", "B", "A"};
const std::vector<std::string> kRgbe = {"R", "G", "B", "error.R", "error.G", "error.B"};

Metrics compare(const Image& a, const Image& r, const MetricOptions& options = {}) {
    Metrics m;
    const Status status = compare_images(a, r, options, m);
    INFO(status.message);
    REQUIRE(status);
    return m;
}

/// r + deviation * normal noise, with the deviation as error layers.
Image noisy(int side, double deviation, std::uint32_t seed, double offset = 0) {
    return make_picture(side, side, kRgbe, [&](int c, int x, int y) {
        if (c >= 3) return deviation;
        const double r = 0.5 + 0.25 * c + 0.01 * (x % 7);
        return r + offset + deviation * test::normal(seed, std::uint32_t(3 * (y * side + x) + c));
    });
}

}  // namespace

TEST_CASE("metrics: four pixels by hand, one of them outside the cloud") {
    // r = 1, 2, 4 in the counted pixels and d = 0.1, -0.2, 0.4; the fourth has alpha 0.02 exactly.
    const double r[4] = {1, 2, 4, 100}, d[4] = {0.125, -0.25, 0.5, 7};
    const float alpha[4] = {1, 0.5f, 0.0201f, 0.02f};
    const Image reference = make_picture(2, 2, kRgba, [&](int c, int x, int y) {
        return c == 3 ? double(alpha[2 * y + x]) : r[2 * y + x];
    });
    const Image a = make_picture(2, 2, {"R", "G", "B"},
                                 [&](int, int x, int y) { return r[2 * y + x] + d[2 * y + x]; });
    MetricOptions exact;
    exact.alpha_least = double(0.02f);
    const Metrics m = compare(a, reference, exact);
    CHECK(m.pixels == 4);
    CHECK(m.cloud_pixels == 3);
    CHECK(m.has_alpha);
    CHECK_FALSE(m.has_error_a);
    const double mean = 7.0 / 3, eps = 0.0001 * mean * mean;
    CHECK(m.mean_reference == doctest::Approx(mean).epsilon(1e-14));
    CHECK(m.mean_a == doctest::Approx(7.375 / 3).epsilon(1e-14));
    CHECK(m.bias == doctest::Approx(0.125).epsilon(1e-14));
    CHECK(m.rmse == doctest::Approx(std::sqrt(0.328125 / 3)).epsilon(1e-14));
    const double wanted = (0.015625 / (1 + eps) + 0.0625 / (4 + eps) + 0.25 / (16 + eps)) / 3;
    CHECK(m.relmse_raw == doctest::Approx(wanted).epsilon(1e-14));
    CHECK(m.relmse == m.relmse_raw);
    CHECK(m.largest == 0.5);
    CHECK(m.largest_x == 0);
    CHECK(m.largest_y == 1);
    CHECK(m.uncounted_largest == 7);
    CHECK(m.uncounted_x == 1);
    CHECK(m.uncounted_y == 1);
    CHECK(m.percentile_999 == 0.5);
    CHECK(std::isnan(m.bias_z));
    CHECK(m.z_count == 0);
    // All pixels, and a reference without alpha, count the fourth.
    MetricOptions all;
    all.alpha_least = -1;
    CHECK(compare(a, reference, all).cloud_pixels == 4);
    CHECK(compare(reference, a).cloud_pixels == 4);
    CHECK_FALSE(compare(reference, a).has_alpha);
}

TEST_CASE("metrics: a picture against itself is zero everywhere") {
    const Image a = noisy(20, 0.1, 1);
    const Metrics m = compare(a, a);
    for (double figure : {m.rmse, m.relmse_raw, m.largest, m.percentile_999, m.bias, m.bias_z,
                          m.relative_percentile_999, m.relmse_trimmed, m.z_square_mean})
        CHECK(figure == 0);
    CHECK(m.relmse == 0);
    CHECK(m.relmse_reference_noise > 0);
    CHECK(m.z_count == 1200);
}

TEST_CASE("metrics: identical pictures with error layers differ by exactly nothing") {
    const Image a = noisy(16, 0.1, 1);
    const Metrics m = compare(a, a);
    CHECK(m.has_error_reference);
    CHECK(m.relmse_reference_noise > 0);
    CHECK(m.identical);
    CHECK(m.relmse == 0);
    CHECK_FALSE(std::signbit(m.relmse));
    // One value more, and the noise counts again.
    Image b = noisy(16, 0.1, 1);
    b.channels[0].pixels[7] *= 1.0001f;
    const Metrics other = compare(b, a);
    CHECK_FALSE(other.identical);
    CHECK(other.relmse < 0);
    Metrics halves;
    REQUIRE(compare_with_halves(a, a, a, {}, halves));
    CHECK(halves.relmse == 0);
}

TEST_CASE("metrics: percentiles by nearest rank, and what trimming leaves") {
    // |d| = 1..1000 eighths in shuffled order, one channel each side by side: 3000 values.
    const Image r = make_picture(50, 20, {"Y"}, [](int, int, int) { return 1024.0; });
    const auto rank = [](int x, int y) { return (x + 50 * y) * 7 % 1000 + 1; };
    const Image a = make_picture(50, 20, {"Y"}, [&](int, int x, int y) {
        return 1024.0 + (rank(x, y) % 2 ? 0.125 : -0.125) * rank(x, y);
    });
    const Metrics m = compare(a, r);
    CHECK(m.largest == 125);
    CHECK(m.percentile_999 == 0.125 * 999);  // rank ceil(0.999 * 3000) = 2997, the last of 999's
    const double scale = 1024 * std::sqrt(1.0001);
    CHECK(m.relative_percentile_999 == doctest::Approx(0.125 * 999 / scale).epsilon(1e-7));
    double sum = 0;
    for (int n = 1; n <= 999; ++n) sum += 3 * 0.015625 * n * n;
    CHECK(m.relmse_trimmed == doctest::Approx(sum / 2997 / (scale * scale)).epsilon(1e-7));
    CHECK(m.relmse_trimmed < m.relmse_raw);
}

TEST_CASE("metrics: relMSE loses the reference's noise, z values are normal, the bias is seen") {
    // 3 * 160^2 values: shares of |z| have standard errors of 7.5e-4 and 1.9e-4, mean z^2
    // of 5.1e-3.
    const int side = 160;
    const double n = 3.0 * side * side, sa = 0.02, sr = 0.05;
    const Metrics m = compare(noisy(side, sa, 11), noisy(side, sr, 12));
    std::printf("relMSE %.4g of which own noise %.4g; z^2 %.4f, |z| > 2: %.4f, > 3: %.5f\n",
                m.relmse, m.relmse_own_noise, m.z_square_mean, m.z_above_2, m.z_above_3);
    CHECK(std::fabs(m.z_square_mean - 1) < 4.5 * std::sqrt(2 / n));
    CHECK(std::fabs(m.z_above_2 - 0.0455) < 4.5 * std::sqrt(0.0455 * 0.9545 / n));
    CHECK(std::fabs(m.z_above_3 - 0.0027) < 4.5 * std::sqrt(0.0027 * 0.9973 / n));
    // The terms' variance is 2 (own + reference)^2 times that of 1/r^2, at most 4.
    const double error = std::sqrt(2 / n) * 2 * m.relmse_raw;
    CHECK(std::fabs(m.relmse - m.relmse_own_noise) < 4.5 * error);
    CHECK(m.relmse_reference_noise > 10 * error);
    CHECK(std::fabs(m.bias_z) < 4.5);
    // Channels are independent here, so that the stated error is sqrt(3) too wide, never too small.
    CHECK(m.bias_standard_error ==
          doctest::Approx(std::sqrt(sa * sa + sr * sr) / side).epsilon(1e-6));
    CHECK(m.bias_standard_error_most ==
          doctest::Approx(std::sqrt(sa * sa + sr * sr)).epsilon(1e-6));
    const Metrics off = compare(noisy(side, sa, 11, 0.01), noisy(side, sr, 12));
    CHECK(off.bias - m.bias == doctest::Approx(0.01).epsilon(1e-5));
    CHECK(off.bias_z > 20);
    CHECK(off.bias_z_least < 1);
}

TEST_CASE("metrics: two halves give the product form of relMSE") {
    const int side = 40;
    const Image a = noisy(side, 0.02, 1), h1 = noisy(side, 0.07, 2), h2 = noisy(side, 0.07, 3);
    Metrics m;
    REQUIRE(compare_with_halves(a, h1, h2, {}, m));
    double mean = 0, sum = 0;
    for (int pass = 0; pass < 2; ++pass)
        for (int n = 0; n < 3 * side * side; ++n) {
            const auto c = std::size_t(n / (side * side));
            const int x = n % side, y = n / side % side;
            const float* r1 = h1.channels[c].pixels.data();
            const float* r2 = h2.channels[c].pixels.data();
            const auto product = [&](int u, int v) {
                return double(r1[v * side + u]) * double(r2[v * side + u]);
            };
            const double p = double(a.channels[c].pixels[std::size_t(y * side + x)]);
            const double q1 = double(r1[y * side + x]), q2 = double(r2[y * side + x]);
            double smooth = 0, count = 0;
            for (int v = std::max(y - 2, 0); v <= std::min(y + 2, side - 1); ++v)
                for (int u = std::max(x - 2, 0); u <= std::min(x + 2, side - 1); ++u)
                    if (u != x || v != y) smooth += product(u, v), ++count;
            if (pass == 0)
                mean += (q1 + q2) / 9600;
            else
                sum += (p - q1) * (p - q2) / (smooth / count + 1e-4 * mean * mean) / 4800;
        }
    // The merged reference is rounded to floats: 6e-8 of r against differences of 0.05.
    CHECK(m.relmse == doctest::Approx(sum).epsilon(2e-5));
    CHECK(m.relmse_raw > 3 * m.relmse);
    CHECK(m.z_count == 0);
    CHECK(std::isfinite(m.bias_z));
}

TEST_CASE("metrics: halves of much noise leave relMSE what it is") {
    // A picture 10 % too bright, a reference of 1 whose halves have a noise of 0.25 and 0.5.
    const int side = 200;
    const auto flat = [&](double light, double deviation, std::uint32_t seed) {
        return make_picture(side, side, {"R", "G", "B"}, [&](int c, int x, int y) {
            const auto index = std::uint32_t(3 * (y * side + x) + c);
            return light + deviation * test::normal(seed, index);
        });
    };
    for (const double deviation : {0.25, 0.5}) {
        Metrics m;
        REQUIRE(compare_with_halves(flat(1.1, 0, 1), flat(1, deviation, 2), flat(1, deviation, 3),
                                    {}, m));
        // A term (0.1 - n1)(0.1 - n2) scatters by v = deviation^2 and by 0.14 deviation; the mean
        // of 24 products raises 1/s by its variance, (v^2 + 2 v)/24, twice that at the corners.
        const double v = deviation * deviation, n = 3.0 * side * side;
        const double error = std::sqrt((v * v + 0.02 * v) / n) * (1 + 2 * v);
        std::printf("noise %.1f: relMSE %.5f +- %.5f, raw %.3f\n", deviation, m.relmse, error,
                    m.relmse_raw);
        CHECK(std::fabs(m.relmse - 0.01) < 4.5 * error + 0.01 * (v * v + 2 * v) / 12);
        CHECK(m.relmse_raw > 3 * m.relmse);
    }
}

TEST_CASE("metrics: what is not finite is counted and left out; a black reference") {
    Image a = noisy(8, 0.1, 1), r = noisy(8, 0.1, 2);
    const Metrics before = compare(a, r);
    a.channels[1].pixels[5] = std::numeric_limits<float>::quiet_NaN();
    r.channels[4].pixels[6] = std::numeric_limits<float>::infinity();
    const Metrics m = compare(a, r);
    CHECK(m.not_finite == 2);
    CHECK(m.cloud_pixels == before.cloud_pixels - 2);
    CHECK(std::isfinite(m.relmse));
    const Image black = test::flat_picture(4, 4, 0, 0, 0);
    CHECK(compare(black, black).relmse == 0);
    CHECK(std::isinf(compare(test::flat_picture(4, 4, 0, 1, 0), black).relmse));
}

TEST_CASE("metrics: differences without any standard error are counted apart") {
    Image a = noisy(4, 0.1, 1), r = noisy(4, 0.1, 2);
    for (Image* image : {&a, &r}) image->channels[3].pixels[0] = 0;
    const Metrics m = compare(a, r);
    CHECK(m.z_unknown == 1);
    CHECK(m.z_count == 47);
}

TEST_CASE("metrics: faults") {
    const Image a = test::flat_picture(4, 3, 1, 1, 1);
    Metrics m;
    const Status sizes = compare_images(a, test::flat_picture(3, 4, 1, 1, 1), {}, m);
    CHECK(sizes.code == Code::kBadInput);
    CHECK(sizes.message == "compare: sizes: differ, 4 x 3, allowed: 3 x 4");
    const Image none = make_picture(4, 3, {"Z"}, [](int, int, int) { return 1.0; });
    CHECK(compare_images(a, none, {}, m).message ==
          "image: channel R: missing, allowed: R G B, or Y");
    const Image clear = make_picture(4, 3, kRgba, [](int c, int, int) { return c == 3 ? 0. : 1.; });
    CHECK(compare_images(a, clear, {}, m).code == Code::kBadInput);
    Image merged;
    CHECK(merge_halves(a, test::flat_picture(3, 4, 1, 1, 1), merged).code == Code::kBadInput);
}

TEST_CASE("metrics: the same bits on every machine") {
    // Neither libm nor the order of a sort may reach a figure: the digest is that of any build.
    const Image a = make_picture(61, 43, kRgbe, [](int c, int x, int y) {
        return 0.1 + ((x * 7 + y * 13 + c * 5) % 31) / 32.0;
    });
    const Image r = make_picture(61, 43, kRgbe, [](int c, int x, int y) {
        return 0.1 + ((x * 5 + y * 11 + c * 3) % 29) / 32.0;
    });
    MetricOptions options;
    options.flip = true;
    const Metrics m = compare(a, r, options);
    Digest digest;
    const double figures[] = {m.rmse,   m.relmse,       m.relmse_trimmed, m.relative_percentile_999,
                              m.bias_z, m.bias_z_least, m.z_square_mean,  m.flip_mean};
    digest.doubles({figures, 8});
    CHECK(digest.hex() == "156ce79e1eb73de9");
}
