// SPDX-License-Identifier: Apache-2.0
// Pearson's chi-square against expected counts, and the two-stage rule for statistical tests.
// in: counts and expectations -> out: statistic, degrees of freedom, p-value.
// Incomplete gamma function by series and continued fraction: Abramowitz, Stegun 6.5.29, 6.5.31.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace pileus {

/// Q(a, x): the share of a gamma distribution of shape a beyond x; in [0, 1], a > 0, x >= 0.
inline double upper_gamma(double a, double x) {
    if (x <= 0) return 1;
    const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (int i = 1; i < 10000 && term > sum * 1e-16; ++i) sum += term *= x / (a + i);
        return 1 - front * sum;
    }
    // Lentz's method, forwards.
    double b = x + 1 - a, c = 1e300, d = 1 / b, f = d;
    for (int i = 1; i < 10000; ++i) {
        const double an = -i * (i - a);
        b += 2;
        d = 1 / (an * d + b);
        c = b + an / c;
        f *= d * c;
        if (std::fabs(d * c - 1) < 1e-15) break;
    }
    return front * f;
}

struct ChiSquare {
    double statistic;
    int freedom;
    double p;
};

/// Both arrays of one length, every expectation >= 5; totals must agree (one constraint).
inline ChiSquare chi_square(const std::vector<std::int64_t>& counts,
                            const std::vector<double>& expected) {
    double sum = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double d = double(counts[i]) - expected[i];
        sum += d * d / expected[i];
    }
    const int freedom = int(counts.size()) - 1;
    return {sum, freedom, upper_gamma(0.5 * freedom, 0.5 * sum)};
}

/// True when p > 1e-6 for 2^20 samples, or else for 16 times as many under a new seed: a right
/// sampler fails by chance once in 1e12. `count(seed, samples)` returns a ChiSquare.
template <class Count>
bool two_stage_chi_square(const char* name, std::uint64_t seed, Count count) {
    for (int stage = 0; stage < 2; ++stage) {
        const std::int64_t samples = std::int64_t(1) << (20 + 4 * stage);
        const ChiSquare c = count(seed + std::uint64_t(stage) * 1000003u, samples);
        std::printf("chi-square %-32s samples %lld  chi2 %9.2f  freedom %d  p %.3g\n", name,
                    (long long)samples, c.statistic, c.freedom, c.p);
        if (c.p > 1e-6) return true;
    }
    return false;
}

}  // namespace pileus
