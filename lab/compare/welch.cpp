// SPDX-License-Identifier: Apache-2.0
// See welch.h.
// in: sums -> out: deviates and probabilities, in doubles and a fixed order.
// docs/crosscheck.md, "Welch tests"
#include "lab/compare/welch.h"

#include <algorithm>
#include <cmath>

namespace pileus {
namespace {

struct Mean {
    double mean = 0, variance = 0, freedom = 1;  ///< variance of the mean
};

Mean mean_of(double n, const BlockSum& s) {
    const double mean = s.sum / n;
    const double variance = std::max(s.square / n - mean * mean, 0.0) / (n - 1);
    return {mean, variance, n - 1};
}

/// What arithmetic other than ours may leave of a difference: a millionth of the mean.
double rounding(const Mean& a, const Mean& b) {
    const double unit = 1e-6 * std::max(std::fabs(a.mean), std::fabs(b.mean));
    return unit * unit;
}

double error_of(const Mean& a, const Mean& b) {
    return std::sqrt(a.variance + b.variance + rounding(a, b));
}

/// Deviate whose two-sided probability is `p`.
double deviate_of(double p) {
    double low = 0, high = 40;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (two_sided(middle) > p ? low : high) = middle;
    }
    return low;
}

/// Relative bias that a test of `error` finds in 99.9 % of cases.
double detectable(const Mean& b, double error, double critical) {
    return b.mean != 0 ? (critical + 3.09) * error / std::fabs(b.mean) : 0;
}

/// How many of the sorted probabilities Holm rejects, and the smallest one adjusted.
std::size_t holm(std::vector<double> p, double significance, double& adjusted) {
    std::sort(p.begin(), p.end());
    adjusted = p.empty() ? 1 : std::min(1.0, p[0] * double(p.size()));
    std::size_t rejected = 0;
    while (rejected < p.size() && p[rejected] * double(p.size() - rejected) <= significance)
        ++rejected;
    return rejected;
}

/// P(chi-square of k degrees >= k times `ratio`): Wilson and Hilferty 1931.
double chi_square_tail(double ratio, double k) {
    const double spread = 2 / (9 * k);
    return 0.5 * std::erfc((std::cbrt(ratio) - (1 - spread)) / std::sqrt(2 * spread));
}

/// Counts one block's deviate.
void take(double z, std::size_t block, int channel, int columns, WelchResult& r) {
    r.above_2 += std::fabs(z) > 2 ? 1 : 0;
    r.above_3 += std::fabs(z) > 3 ? 1 : 0;
    if (std::fabs(z) <= std::fabs(r.largest_z)) return;
    r.largest_z = z;
    r.largest_x = int(block % std::size_t(columns));
    r.largest_y = int(block / std::size_t(columns));
    r.largest_channel = channel;
}

void test_blocks(const BlockSums& a, const BlockSums& b, WelchResult& r) {
    std::vector<double> all, found;
    const auto idle = [&](std::size_t at) {
        return cannot_differ(a.passes[at / 3], a.sums[at], b.passes[at / 3], b.sums[at]);
    };
    for (std::size_t at = 0; at < 3 * r.blocks; ++at) r.tested += idle(at) ? 0 : 1;
    if (r.tested == 0) return;
    const double critical = deviate_of(0.5 * r.significance / double(r.tested));
    for (int c = 0; c < 3; ++c) {
        double square = 0, count = 0;
        for (std::size_t i = 0; i < r.blocks; ++i) {
            const std::size_t at = 3 * i + std::size_t(c);
            if (idle(at)) continue;
            ++count;
            const double z = welch_z(a.passes[i], a.sums[at], b.passes[i], b.sums[at]);
            take(z, i, c, a.columns(), r);
            square += z * z;
            all.push_back(two_sided(z));
            const Mean ma = mean_of(a.passes[i], a.sums[at]), mb = mean_of(b.passes[i], b.sums[at]);
            if (mb.mean != 0) found.push_back(detectable(mb, error_of(ma, mb), critical));
        }
        if (!(count > 0)) continue;
        r.mean_z_square[c] = square / count;
        r.chi_square_p[c] = chi_square_tail(r.mean_z_square[c], count);
    }
    r.above_2 /= double(all.size());
    r.above_3 /= double(all.size());
    r.smallest_p = *std::min_element(all.begin(), all.end());
    r.rejected = holm(std::move(all), 0.5 * r.significance, r.adjusted_p);
    if (found.empty()) return;
    std::nth_element(found.begin(), found.begin() + std::ptrdiff_t(found.size() / 2), found.end());
    r.detectable_block = found[found.size() / 2];
}

}  // namespace

bool cannot_differ(double passes_a, const BlockSum& a, double passes_b, const BlockSum& b) {
    const Mean x = mean_of(passes_a, a), y = mean_of(passes_b, b);
    const double unit = rounding(x, y), d = x.mean - y.mean;
    return x.variance + y.variance <= unit && d * d <= unit;
}

double two_sided(double z) { return std::erfc(std::fabs(z) * 0.70710678118654752); }

double welch_z(double passes_a, const BlockSum& a, double passes_b, const BlockSum& b) {
    const Mean x = mean_of(passes_a, a), y = mean_of(passes_b, b);
    const double sum = x.variance + y.variance, error = error_of(x, y);
    if (!(error > 0)) return 0;
    const double t = (x.mean - y.mean) / error;
    if (!(sum > 0)) return t;
    // Welch and Satterthwaite's degrees of freedom.
    const double freedom =
        sum * sum / (x.variance * x.variance / x.freedom + y.variance * y.variance / y.freedom);
    const double size =
        std::sqrt(freedom * std::log1p(t * t / freedom)) * (8 * freedom + 1) / (8 * freedom + 3);
    return std::copysign(size, t);
}

Status compare_welch(const BlockSums& a, const BlockSums& b, double significance, WelchResult& r) {
    if (a.width != b.width || a.height != b.height || a.side != b.side)
        return Status::bad_input(
            "blocks: " + std::to_string(a.width) + " x " + std::to_string(a.height) + " by " +
            std::to_string(a.side) + " against " + std::to_string(b.width) + " x " +
            std::to_string(b.height) + " by " + std::to_string(b.side) + ", allowed: one size");
    r = {};
    r.significance = significance;
    r.blocks = a.blocks() - 1;
    r.passes_a = *std::min_element(a.passes.begin(), a.passes.end());
    r.passes_b = *std::min_element(b.passes.begin(), b.passes.end());
    test_blocks(a, b, r);

    const std::size_t last = r.blocks;
    const double critical = deviate_of(0.5 * significance / 3);
    std::vector<double> p;
    for (std::size_t c = 0; c < 3; ++c) {
        const BlockSum &sa = a.sums[3 * last + c], &sb = b.sums[3 * last + c];
        const Mean x = mean_of(a.passes[last], sa), y = mean_of(b.passes[last], sb);
        const double z = welch_z(a.passes[last], sa, b.passes[last], sb);
        r.picture[c] = {x.mean, y.mean, z, two_sided(z), detectable(y, error_of(x, y), critical)};
        p.push_back(r.picture[c].p);
    }
    double ignored = 1;
    r.differ = r.rejected > 0 || holm(std::move(p), 0.5 * significance, ignored) > 0;
    return Status::ok();
}

}  // namespace pileus
