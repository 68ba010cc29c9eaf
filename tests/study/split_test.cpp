// SPDX-License-Identifier: Apache-2.0
// Bias and noise apart, on pictures whose bias and noise are known.
// in: pictures made of counted random numbers -> out: checks against closed forms.
// docs/study.md, "Bias and noise apart"
#include <doctest/doctest.h>

#include <cmath>

#include "lab/compare/metrics.h"
#include "tools/study/study_split.h"

using namespace pileus;

namespace {

constexpr int kSide = 64;

/// R = G = B = 1 + bias + noise that is even on [-1, 1] times `spread`; alpha 1 but for one row.
Image picture(double bias, double spread, std::uint32_t seed) {
    Image image;
    image.width = image.height = kSide;
    for (const char* name : {"R", "G", "B", "A"}) {
        image.channels.emplace_back();
        image.channels.back().name = name;
        REQUIRE(image.channels.back().pixels.resize(kSide * kSide, "test"));
    }
    // A linear congruence is random enough here: its high bits in order.
    std::uint64_t state = 0x9E3779B97F4A7C15ull * (seed + 1);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < std::size_t(kSide) * kSide; ++i) {
            state = state * 6364136223846793005ull + 1442695040888963407ull;
            const double even = double(state >> 11) * 0x1p-53;
            image.channels[c].pixels[i] = float(1 + bias + spread * (2 * even - 1));
        }
    for (std::size_t i = 0; i < std::size_t(kSide) * kSide; ++i)
        image.channels[3].pixels[i] = i < kSide ? 0.0f : 1.0f;
    return image;
}

std::vector<Image> pictures(double bias, double spread, int seeds) {
    std::vector<Image> all;
    for (int s = 0; s < seeds; ++s) all.push_back(picture(bias, spread, std::uint32_t(10 + s)));
    return all;
}

}  // namespace

TEST_CASE("bias and noise of pictures come back, without the noise of the reference") {
    const double bias = 0.05, spread = 0.3, variance = spread * spread / 3;
    // The reference's noise is small: it enters the weights 1/(r^2 + eps), by 4 bias variance.
    const double reference_variance = 0.02 * 0.02 / 3;
    const Image half1 = picture(0, 0.02, 1), half2 = picture(0, 0.02, 2);
    ErrorSplit split;
    REQUIRE(split_error(pictures(bias, spread, 8), half1, half2, split));
    // 1/(r^2 + eps) is 1 - eps about a reference of 1.
    const double weight = 1 - 1e-4;
    const double n = 3.0 * kSide * (kSide - 1);
    // Four standard errors of a mean of n squares, of noise and of what bias times noise adds.
    const double most_noise = 4 * variance / std::sqrt(n);
    CHECK(std::fabs(split.noise - variance * weight) < most_noise + 0.01 * variance);
    CHECK(std::fabs(split.bias2 - bias * bias * weight) <
          4 * (2 * bias * std::sqrt((variance / 8 + reference_variance / 2) / n) +
               variance / 8 / std::sqrt(n)));
    CHECK(split.relmse == doctest::Approx(split.bias2 + split.noise).epsilon(1e-12));
    CHECK(split.mean_bias == doctest::Approx(bias).epsilon(0.05));
    // The jackknife's error: the spread of bias^2 from eight seeds, here 2 b sd / sqrt(8 n) at
    // least.
    CHECK(split.bias2_error > 0.2 * 2 * bias * std::sqrt(variance / 8 / n));
    CHECK(split.bias2_error <
          5 * (2 * bias * std::sqrt(variance / 8 / n) + variance / std::sqrt(n)));

    ReferenceNoise noise;
    REQUIRE(reference_noise(half1, half2, noise));
    CHECK(noise.noise == doctest::Approx(reference_variance / 2).epsilon(0.03));
    CHECK(noise.cloud_pixels == std::uint64_t(kSide) * (kSide - 1));
    CHECK(noise.resolution < 4 * noise.noise / std::sqrt(n));
}

TEST_CASE("without a bias none is found") {
    ErrorSplit split;
    REQUIRE(split_error(pictures(0, 0.3, 8), picture(0, 0.02, 1), picture(0, 0.02, 2), split));
    CHECK(std::fabs(split.bias2) < 4 * split.bias2_error + 1e-4);
}

TEST_CASE("relMSE is that of compare_with_halves") {
    const Image half1 = picture(0, 0.2, 1), half2 = picture(0, 0.2, 2);
    const std::vector<Image> all = pictures(0.05, 0.3, 3);
    ErrorSplit split;
    REQUIRE(split_error(all, half1, half2, split));
    for (std::size_t s = 0; s < 3; ++s) {
        Metrics metrics;
        REQUIRE(compare_with_halves(all[s], half1, half2, MetricOptions(), metrics));
        // The mean of the halves is a float there, and both ways sum 12 000 terms.
        CHECK(split.each[s] == doctest::Approx(metrics.relmse).epsilon(1e-5));
    }
}

TEST_CASE("a matrix of two and of one seed leaves open what it cannot tell") {
    ErrorSplit split;
    split_matrix({0.3, 0.1, 0.1, 0.5}, 2, split);
    CHECK(split.relmse == doctest::Approx(0.4));
    CHECK(split.bias2 == doctest::Approx(0.1));
    CHECK(split.noise == doctest::Approx(0.3));
    CHECK(std::isnan(split.bias2_error));
    split_matrix({0.3}, 1, split);
    CHECK(split.relmse == 0.3);
    CHECK(std::isnan(split.bias2));
    CHECK(std::isnan(split.relmse_error));
}

TEST_CASE("three seeds: the jackknife by hand") {
    // Without seed 0, 1, 2 the bias^2 is G12, G02, G01.
    ErrorSplit split;
    split_matrix({1, 0.1, 0.2, 0.1, 2, 0.3, 0.2, 0.3, 3}, 3, split);
    CHECK(split.bias2 == doctest::Approx(0.2));
    CHECK(split.noise == doctest::Approx(1.8));
    CHECK(split.bias2_error == doctest::Approx(std::sqrt(2.0 / 3 * 0.02)));
}

TEST_CASE("pictures that do not fit are refused") {
    Image small = picture(0, 0, 1);
    small.width = kSide / 2;
    std::vector<Image> pictures_of_half;
    pictures_of_half.push_back(std::move(small));
    ErrorSplit split;
    CHECK(split_error(pictures_of_half, picture(0, 0, 1), picture(0, 0, 2), split).code ==
          Code::kBadInput);
    Image clear = picture(0, 0, 1);
    for (float& alpha : clear.channels[3].pixels.span()) alpha = 0;
    ReferenceNoise noise;
    CHECK(reference_noise(clear, clear, noise).code == Code::kBadInput);
}
