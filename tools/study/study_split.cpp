// SPDX-License-Identifier: Apache-2.0
// Sums of products of differences: every mean over seeds follows from one small matrix.
// in: pictures -> out: see study_split.h.
// docs/study.md, "Bias and noise apart"
#include "tools/study/study_split.h"

#include <cmath>

#include "lab/compare/metrics.h"
#include "lab/compare/metrics_pair.h"

namespace pileus {

namespace {

/// Mean radiance of the reference over what counts, and how many values these are.
double mean_of(const PicturePair& pair, double& values) {
    double sum = 0;
    values = 0;
    each_counted(pair, [&](std::size_t i, int) {
        for (int c = 0; c < 3; ++c) sum += double(pair.r[c][i]);
        values += 3;
    });
    return values > 0 ? sum / values : 0;
}

Status pair_all(const Image& half1, const Image& half2, Image& reference, PicturePair& pair,
                SmoothSquares& smooth) {
    PILEUS_TRY(merge_halves(half1, half2, reference));
    PILEUS_TRY(pair_pictures(half1, reference, MetricOptions().alpha_least, pair));
    return smooth_squares(half1, half2, pair, smooth);
}

Status no_cloud() {
    return Status::bad_input(
        "reference: pixels: none of alpha above 0.02, 0, allowed: a picture with a cloud");
}

}  // namespace

Status reference_noise(const Image& half1, const Image& half2, ReferenceNoise& noise) {
    Image reference;
    PicturePair pair;
    SmoothSquares smooth;
    PILEUS_TRY(pair_all(half1, half2, reference, pair, smooth));
    double values = 0;
    noise.mean = mean_of(pair, values);
    if (!(values > 0)) return no_cloud();
    const double epsilon = 1e-4 * noise.mean * noise.mean;
    double sum = 0, squares = 0;
    each_counted(pair, [&](std::size_t i, int) {
        for (int c = 0; c < 3; ++c) {
            const double unit = pair.square(c, i) + epsilon, d = 2 * pair.difference(c, i);
            const double term = unit > 0 ? d * d / unit : 0;
            sum += term / 4;
            // E d^4 = 3 (E d^2)^2 where the noise is normal, and half of d^2 is that of one half.
            squares += term * term / 12;
        }
    });
    noise.noise = sum / values;
    noise.resolution = std::sqrt(squares) / values;
    noise.cloud_pixels = std::uint64_t(values / 3);
    return Status::ok();
}

void split_matrix(const std::vector<double>& matrix, int seeds, ErrorSplit& split) {
    const std::size_t k = std::size_t(seeds);
    const double n = double(seeds);
    const double unknown = kNotKnown;
    double diagonal = 0, all = 0;
    std::vector<double> row(k, 0);
    split.each.clear();
    for (std::size_t i = 0; i < k; ++i) {
        split.each.push_back(matrix[i * k + i]);
        diagonal += matrix[i * k + i];
        for (std::size_t j = 0; j < k; ++j) row[i] += matrix[i * k + j];
        all += row[i];
    }
    split.relmse = diagonal / n;
    split.relmse_error = split.bias2 = split.bias2_error = split.noise = unknown;
    if (seeds < 2) return;
    double scatter = 0;
    for (const double one : split.each) scatter += (one - split.relmse) * (one - split.relmse);
    split.relmse_error = std::sqrt(scatter / (n * (n - 1)));

    // Different seeds share the bias and nothing else.
    split.bias2 = (all - diagonal) / (n * (n - 1));
    split.noise = split.relmse - split.bias2;
    if (seeds < 3) return;
    double mean = 0, spread = 0;
    std::vector<double> without(k);
    for (std::size_t i = 0; i < k; ++i) {
        const double rest = all - 2 * row[i] + matrix[i * k + i];
        without[i] = (rest - (diagonal - matrix[i * k + i])) / ((n - 1) * (n - 2));
        mean += without[i] / n;
    }
    for (const double one : without) spread += (one - mean) * (one - mean);
    split.bias2_error = std::sqrt((n - 1) / n * spread);
}

Status split_error(const std::vector<Image>& pictures, const Image& half1, const Image& half2,
                   ErrorSplit& split) {
    Image reference;
    PicturePair pair, second;
    SmoothSquares smooth;
    PILEUS_TRY(pair_all(half1, half2, reference, pair, smooth));
    PILEUS_TRY(pair_pictures(half2, reference, MetricOptions().alpha_least, second));
    double values = 0;
    const double mean = mean_of(pair, values);
    if (!(values > 0)) return no_cloud();
    const double epsilon = 1e-4 * mean * mean;
    const std::size_t k = pictures.size();
    std::vector<PicturePair> pairs(k);
    for (std::size_t s = 0; s < k; ++s)
        PILEUS_TRY(pair_pictures(pictures[s], reference, MetricOptions().alpha_least, pairs[s]));

    std::vector<double> matrix(k * k, 0), from1(k), from2(k);
    double bias = 0, counted = 0;
    each_counted(pair, [&](std::size_t i, int) {
        for (const PicturePair& one : pairs)
            if (!one.finite(i)) return;
        for (int c = 0; c < 3; ++c) {
            const double r = double(pair.r[c][i]);
            const double unit = pair.square(c, i) + epsilon;
            if (!(unit > 0)) continue;
            for (std::size_t s = 0; s < k; ++s) {
                const double x = double(pairs[s].a[c][i]);
                from1[s] = x - double(pair.a[c][i]);
                from2[s] = x - double(second.a[c][i]);
                bias += x - r;
            }
            for (std::size_t s = 0; s < k; ++s)
                for (std::size_t t = 0; t < k; ++t)
                    matrix[s * k + t] += (from1[s] * from2[t] + from1[t] * from2[s]) / (2 * unit);
        }
        counted += 3;
    });
    if (!(counted > 0)) return no_cloud();
    for (double& term : matrix) term /= counted;
    split_matrix(matrix, int(k), split);
    split.mean_bias = mean > 0 ? bias / (counted * double(k) * mean) : 0;
    return Status::ok();
}

}  // namespace pileus
