// SPDX-License-Identifier: Apache-2.0
// Gradient, variance, masses and samplers of the preparation against known answers.
// in: small density fields -> out: passes or fails.
// Elek 2011, sections 5.1-5.2; docs/methods.md 3, prepare 1-2.
#include <doctest/doctest.h>

#include <cstring>

#include "src/methods/collectors/prepare/samples.h"
#include "src/world/grid/grid.h"
#include "tests/law/prepare_fields.h"

using namespace pileus;
using namespace prepare_test;

namespace {

struct Weights {
    std::vector<float> values;
    FieldStats stats;
    Span<float> span() { return {values.data(), values.size()}; }
};

Weights gradient(const Field& f, int threads = 1) {
    Weights w{std::vector<float>(f.rho.size(), -1.0f), {}};
    REQUIRE(bool(gradient_magnitude(f.span(), f.grid, threads, w.span(), w.stats)));
    return w;
}

Weights variance(const Field& f, int radius, int threads = 1) {
    Weights w{std::vector<float>(f.rho.size(), -1.0f), {}};
    REQUIRE(bool(local_variance(f.span(), f.grid, radius, threads, w.span(), w.stats)));
    return w;
}

std::vector<double> masses(const Field& f, int threads = 1) {
    std::vector<double> m(f.rho.size(), -1.0);
    voxel_masses(f.span(), f.grid, threads, {m.data(), m.size()});
    return m;
}

SampleSet draw(bool rejection, Weights& w, const Field& f, const SampleOptions& o, int threads) {
    SampleSet set;
    const auto sampler = rejection ? sample_rejection : sample_stratified;
    REQUIRE(bool(sampler(w.span(), w.stats, f.span(), f.grid, o, threads, set)));
    return set;
}

std::size_t voxel_of(const Grid& g, const Sample& s) {
    return voxel_index(g, int(s.x[0]), int(s.x[1]), int(s.x[2]));
}

/// Wilson and Hilferty's normal deviate of a chi-square value.
double deviate(double chi2, double freedom) {
    const double v = 2.0 / (9.0 * freedom);
    return (std::cbrt(chi2 / freedom) - (1.0 - v)) / std::sqrt(v);
}

/// Chi-square deviate of samples against weights, over voxels joined until ten are expected.
double chi_square(const Grid& g, const SampleSet& set, const Weights& w) {
    std::vector<double> counts(w.values.size(), 0.0);
    for (const Sample& s : set.samples.span()) counts[voxel_of(g, s)] += 1.0;
    double chi2 = 0, expected = 0, seen = 0;
    int bins = 0;
    for (std::size_t v = 0; v < w.values.size(); ++v) {
        expected += double(w.values[v]) / w.stats.sum * double(set.samples.size());
        seen += counts[v];
        if (expected < 10) continue;
        chi2 += (seen - expected) * (seen - expected) / expected;
        expected = seen = 0;
        ++bins;
    }
    REQUIRE(bins > 20);
    return deviate(chi2, bins - 1);
}

}  // namespace

TEST_CASE("law: the gradient of a ramp is its slope in metres, cells of any shape") {
    Field f = zeros(6, 5, 4, 0.5f, 2.0f, 4.0f);
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 5; ++j)
            for (int i = 0; i < 6; ++i)
                f.at(i, j, k) = 1.0f + 1.0f * float(i) + 3.0f * float(j) + 8.0f * float(k);
    const Weights w = gradient(f);
    // Slopes 2, 1.5 and 2 per metre: all numbers are exact in float but the root.
    const float inside = std::sqrt(4.0f + 2.25f + 4.0f);
    for (int k = 1; k < 3; ++k)
        for (int j = 1; j < 4; ++j)
            for (int i = 1; i < 5; ++i) CHECK(w.values[voxel_index(f.grid, i, j, k)] == inside);
    // At the low x face the outside counts as zero: rho(1, j, k) / (2 * 0.5 m).
    const float gx = f.at(1, 2, 2), rim = std::sqrt(gx * gx + 2.25f + 4.0f);
    CHECK(w.values[voxel_index(f.grid, 0, 2, 2)] == rim);
    const float hx = -f.at(4, 2, 2), far = std::sqrt(hx * hx + 2.25f + 4.0f);
    CHECK(w.values[voxel_index(f.grid, 5, 2, 2)] == far);
    CHECK(w.stats.max == *std::max_element(w.values.begin(), w.values.end()));
    CHECK(w.stats.density_max == f.at(5, 4, 3));
    double sum = 0;
    for (float v : w.values) sum += double(v);
    // Two orders of adding 120 numbers differ by less than 120 ulp.
    CHECK(std::fabs(w.stats.sum - sum) <= 120 * 2.3e-16 * sum);
}

TEST_CASE("law: a uniform box has a gradient at its faces only, a single voxel none") {
    Field f = zeros(5, 5, 5);
    std::fill(f.rho.begin(), f.rho.end(), 1.0f);
    const Weights w = gradient(f);
    CHECK(w.values[voxel_index(f.grid, 2, 2, 2)] == 0.0f);
    CHECK(w.values[voxel_index(f.grid, 0, 2, 2)] == 0.5f);
    CHECK(w.values[voxel_index(f.grid, 2, 2, 4)] == 0.5f);
    Field one = zeros(1, 1, 1);
    one.rho[0] = 3.0f;
    CHECK(gradient(one).stats.sum == 0.0);
    Field row = zeros(1, 1, 3);
    std::fill(row.rho.begin(), row.rho.end(), 1.0f);
    CHECK(gradient(row).values == std::vector<float>{0.5f, 0.0f, 0.5f});
}

TEST_CASE("law: local variance agrees with a direct two-pass sum and cancels nowhere") {
    const Field f = speckle(9, 6, 7, 5);
    for (int radius : {1, 2, 8}) {
        const Weights w = variance(f, radius);
        for (int k = 0; k < 7; ++k)
            for (int j = 0; j < 6; ++j)
                for (int i = 0; i < 9; ++i) {
                    const double count = std::pow(2.0 * radius + 1, 3);
                    double first = 0, second = 0;
                    for (int pass = 0; pass < 2; ++pass) {
                        const double mean = first / count;
                        for (int c = k - radius; c <= k + radius; ++c)
                            for (int b = j - radius; b <= j + radius; ++b)
                                for (int a = i - radius; a <= i + radius; ++a) {
                                    const bool in =
                                        a >= 0 && a < 9 && b >= 0 && b < 6 && c >= 0 && c < 7;
                                    const double r =
                                        in ? double(f.rho[voxel_index(f.grid, a, b, c)]) : 0.0;
                                    if (pass == 0)
                                        first += r;
                                    else
                                        second += (r - mean) * (r - mean);
                                }
                    }
                    // Rounding to 2^-19 of the maximum moves a variance below 1 by 4e-6 at most.
                    const double v = double(w.values[voxel_index(f.grid, i, j, k)]);
                    CHECK(std::fabs(v - second / count) < 4e-6);
                }
    }
    // An interior of 0.1, not a binary fraction, has variance exactly zero.
    Field uniform_box = zeros(12, 12, 12);
    std::fill(uniform_box.rho.begin(), uniform_box.rho.end(), 0.1f);
    const Weights w = variance(uniform_box, 2);
    CHECK(w.values[voxel_index(uniform_box.grid, 5, 6, 5)] == 0.0f);
    CHECK(w.values[voxel_index(uniform_box.grid, 0, 6, 5)] > 0.0f);
    CHECK(variance(zeros(4, 4, 4), 1).stats.sum == 0.0);
}

TEST_CASE("law: the mass of a voxel is the exact integral of the trilinear field") {
    const Field f = speckle(5, 4, 3, 11);
    const std::vector<double> m = masses(f);
    const double cell = 1.0 * 2.0 * 0.5;
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 5; ++i) {
                // The field is linear on each half: the midpoint rule on two halves is exact.
                double sum = 0;
                for (int h = 0; h < 8; ++h) {
                    const float x[3] = {float(i) + 0.25f + 0.5f * float(h & 1),
                                        float(j) + 0.25f + 0.5f * float((h >> 1) & 1),
                                        float(k) + 0.25f + 0.5f * float(h >> 2)};
                    sum += double(density_at(f.span(), f.grid, x)) / 8 * cell;
                }
                // density_at rounds to float: a few 6e-8 of densities below 1.
                CHECK(std::fabs(m[voxel_index(f.grid, i, j, k)] - sum) < 4e-7);
            }
}

TEST_CASE("law: the trilinear field meets the voxel centres, is flat at the rim, bounded") {
    const Field f = speckle(4, 3, 5, 2);
    for (int k = 0; k < 5; ++k)
        for (int i = 0; i < 4; ++i) {
            const float x[3] = {float(i) + 0.5f, 1.5f, float(k) + 0.5f};
            CHECK(density_at(f.span(), f.grid, x) == f.rho[voxel_index(f.grid, i, 1, k)]);
        }
    const float rim[3] = {0.0f, 3.0f, 5.0f}, first[3] = {0.5f, 2.5f, 4.5f};
    CHECK(density_at(f.span(), f.grid, rim) == density_at(f.span(), f.grid, first));
    const float half[3] = {2.0f, 1.5f, 2.5f};
    // One float rounding of a value below 1.
    CHECK(std::fabs(density_at(f.span(), f.grid, half) -
                    0.5f * (f.rho[voxel_index(f.grid, 1, 1, 2)] +
                            f.rho[voxel_index(f.grid, 2, 1, 2)])) < 1.2e-7f);
}

TEST_CASE("law: both samplers follow the field (chi-square, p > 1e-6 with fixed seeds)") {
    const Field f = speckle(7, 6, 5, 21);
    for (bool use_variance : {false, true})
        for (bool rejection : {false, true}) {
            CAPTURE(use_variance);
            CAPTURE(rejection);
            Weights w = use_variance ? variance(f, 1) : gradient(f);
            SampleOptions o;
            o.count = 40000;
            o.seed = 5;
            const SampleSet set = draw(rejection, w, f, o, 1);
            REQUIRE(set.samples.size() == o.count);
            // 4.75 is the normal deviate of p = 1e-6.
            CHECK(chi_square(f.grid, set, w) < 4.75);
            // A wrong law must show: the same samples against flat weights.
            Weights flat{std::vector<float>(w.values.size(), 1.0f),
                         {1, double(w.values.size()), 1}};
            CHECK(chi_square(f.grid, set, flat) > 10);
            // Within a voxel each coordinate is uniform: eight equal parts.
            for (int a = 0; a < 3; ++a) {
                double parts[8] = {}, chi2 = 0;
                for (const Sample& s : set.samples.span())
                    parts[int((s.x[a] - std::floor(s.x[a])) * 8)] += 1;
                for (double p : parts) chi2 += (p - 5000) * (p - 5000) / 5000;
                CHECK(deviate(chi2, 7) < 4.75);
            }
        }
}

TEST_CASE("law: stratified samples keep every cumulative count within one of its share") {
    const Field f = speckle(9, 4, 6, 8);
    Weights w = gradient(f);
    SampleOptions o;
    o.count = 1000;
    const SampleSet set = draw(false, w, f, o, 1);
    std::vector<double> counts(w.values.size(), 0.0);
    for (const Sample& s : set.samples.span()) counts[voxel_of(f.grid, s)] += 1;
    double share = 0, seen = 0;
    for (std::size_t v = 0; v < counts.size(); ++v) {
        share += double(w.values[v]) / w.stats.sum * o.count;
        seen += counts[v];
        // One stratum may lie on either side of the voxel's end; 1e-9 for rounding.
        CHECK(std::fabs(seen - share) < 1.0 + 1e-9);
    }
}

TEST_CASE("law: samples lie inside the box, off the faces, and carry the density there") {
    for (bool rejection : {false, true}) {
        Field f = zeros(4096, 1, 2);
        for (int i = 4000; i < 4096; ++i) f.at(i, 0, 1) = 1.0f;
        Weights w = gradient(f);
        SampleOptions o;
        o.count = 500;
        o.max_tries = 1000000;
        const SampleSet set = draw(rejection, w, f, o, 1);
        REQUIRE(set.samples.size() == 500);
        for (const Sample& s : set.samples.span()) {
            for (int a = 0; a < 3; ++a) {
                CHECK((s.x[a] > 0 && s.x[a] < float(f.grid.size[a])));
                CHECK(s.x[a] != std::floor(s.x[a]));
            }
            CHECK(w.values[voxel_of(f.grid, s)] > 0.0f);
            CHECK(s.density == density_at(f.span(), f.grid, s.x));
        }
    }
}

TEST_CASE("law: a field of zeros gives no samples, hopeless rejection gives up and says so") {
    Field empty = zeros(3, 4, 5);
    Weights none = gradient(empty);
    for (bool rejection : {false, true})
        CHECK(draw(rejection, none, empty, SampleOptions{}, 1).samples.size() == 0);
    Field f = zeros(32, 32, 32);
    f.at(16, 16, 16) = 1.0f;
    Weights w = gradient(f);
    SampleOptions o;
    o.count = 100;
    o.max_tries = 50;
    const SampleSet set = draw(true, w, f, o, 1);
    CHECK(set.given_up + set.samples.size() == 100);
    CHECK(set.given_up > 90);
    CHECK(set.tries <= 5000);
    CHECK(draw(false, w, f, o, 1).samples.size() == 100);
}

TEST_CASE("law: threads, streams and seeds: the first changes no bit, the others all samples") {
    const Field f = balls(24, 20, 16, 4);
    for (bool rejection : {false, true}) {
        std::uint64_t digests[4];
        for (int run = 0; run < 4; ++run) {
            const int threads = run == 1 ? 3 : 1;
            SampleOptions o;
            o.count = 1500;
            o.seed = run == 2 ? 1 : 0;
            o.stream = run == 3 ? 1 : 0;
            Weights w = gradient(f, threads), v = variance(f, 2, threads);
            const SampleSet set = draw(rejection, w, f, o, threads);
            Digest d;
            d.floats({w.values.data(), w.values.size()});
            d.floats({v.values.data(), v.values.size()});
            const auto all = masses(f, threads);
            d.doubles({all.data(), all.size()});
            for (const Sample& s : set.samples.span()) {
                for (float x : s.x) d.f32(x);
                d.f32(s.density);
            }
            digests[run] = d.value();
        }
        CHECK(digests[0] == digests[1]);
        CHECK(digests[0] != digests[2]);
        CHECK(digests[0] != digests[3]);
    }
}
