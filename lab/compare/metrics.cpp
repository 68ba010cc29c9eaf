// SPDX-License-Identifier: Apache-2.0
// Sums the differences of two pictures, row by row, and what their error layers explain of them.
// in: planes of floats -> out: Metrics.
// docs/compare.md
#include "lab/compare/metrics.h"

#include <algorithm>
#include <cmath>

#include "lab/compare/flip.h"
#include "lab/compare/metrics_pair.h"

namespace pileus {

namespace {

constexpr double kPercentile = 0.999;

/// Adds the terms of a row before they are added to the whole, so that rounding stays small.
class RowSum {
public:
    void add(double term, int row) {
        if (row != row_) close(row);
        part_ += term;
    }
    double value() const { return whole_ + part_; }

private:
    void close(int row) {
        whole_ += part_;
        part_ = 0;
        row_ = row;
    }
    double whole_ = 0, part_ = 0;
    int row_ = 0;
};

/// What a pixel that does not count would have to say.
void look_aside(const PicturePair& pair, std::size_t i, Metrics& m) {
    if (!pair.finite(i)) {
        ++m.uncounted_not_finite;
        return;
    }
    for (int c = 0; c < 3; ++c) {
        const double d = std::fabs(pair.difference(c, i));
        if (d <= m.uncounted_largest) continue;
        m.uncounted_largest = d;
        m.uncounted_x = int(i % std::size_t(pair.width));
        m.uncounted_y = int(i / std::size_t(pair.width));
    }
}

void count_and_mean(const PicturePair& pair, Metrics& m) {
    RowSum sum_a, sum_r;
    each_counted(pair, [&](std::size_t i, int y) {
        ++m.cloud_pixels;
        for (int c = 0; c < 3; ++c) {
            sum_a.add(double(pair.a[c][i]), y);
            sum_r.add(double(pair.r[c][i]), y);
        }
    });
    m.pixels = pair.pixels();
    for (std::size_t i = 0; i < m.pixels; ++i) {
        m.not_finite += pair.in_cloud(i) && !pair.finite(i) ? 1 : 0;
        if (!pair.in_cloud(i)) look_aside(pair, i, m);
    }
    const double values = 3.0 * double(m.cloud_pixels);
    m.mean_a = sum_a.value() / values;
    m.mean_reference = sum_r.value() / values;
}

/// square/(r^2 + eps); nothing over nothing is nothing.
double relative(double square, double r_square, double epsilon) {
    return square > 0 ? square / (r_square + epsilon) : 0;
}

void add_errors(const PicturePair& pair, double epsilon, Metrics& m) {
    RowSum square, ratio, bias, noise_a, noise_r;
    each_counted(pair, [&](std::size_t i, int y) {
        for (int c = 0; c < 3; ++c) {
            const double d = pair.difference(c, i), r2 = pair.square(c, i);
            bias.add(d, y);
            square.add(d * d, y);
            ratio.add(relative(d * d, r2, epsilon), y);
            const double ea = m.has_error_a ? double(pair.a_error[c][i]) : 0;
            const double er = m.has_error_reference ? double(pair.r_error[c][i]) : 0;
            noise_a.add(relative(ea * ea, r2, epsilon), y);
            noise_r.add(relative(er * er, r2, epsilon), y);
            if (std::fabs(d) <= m.largest) continue;
            m.largest = std::fabs(d);
            m.largest_x = int(i % std::size_t(pair.width));
            m.largest_y = y;
        }
    });
    const double values = 3.0 * double(m.cloud_pixels);
    m.bias = bias.value() / values;
    m.rmse = std::sqrt(square.value() / values);
    m.relmse_raw = ratio.value() / values;
    m.relmse_own_noise = noise_a.value() / values;
    m.relmse_reference_noise = noise_r.value() / values;
    // A picture that is the reference shares its noise: nothing of it is in the difference.
    m.identical = !(m.largest > 0);
    m.relmse = m.identical ? 0 : m.relmse_raw - m.relmse_reference_noise;
}

/// The standard error of the bias between two laws: independent pixels, and all in step.
void add_bias_error(const PicturePair& pair, Metrics& m) {
    if (!m.has_error_a && !m.has_error_reference) return;
    RowSum square, sum_a, sum_r;
    each_counted(pair, [&](std::size_t i, int y) {
        double ea = 0, er = 0;
        for (int c = 0; c < 3; ++c) {
            ea += m.has_error_a ? double(pair.a_error[c][i]) / 3 : 0;
            er += m.has_error_reference ? double(pair.r_error[c][i]) / 3 : 0;
        }
        square.add(ea * ea + er * er, y);
        sum_a.add(ea, y);
        sum_r.add(er, y);
    });
    const double pixels = double(m.cloud_pixels);
    const double mean_a = sum_a.value() / pixels, mean_r = sum_r.value() / pixels;
    m.bias_standard_error = std::sqrt(square.value()) / pixels;
    m.bias_standard_error_most = std::sqrt(mean_a * mean_a + mean_r * mean_r);
    if (m.bias_standard_error > 0) m.bias_z = m.bias / m.bias_standard_error;
    if (m.bias_standard_error_most > 0) m.bias_z_least = m.bias / m.bias_standard_error_most;
}

void add_z(const PicturePair& pair, Metrics& m) {
    if (!m.has_error_a && !m.has_error_reference) return;
    RowSum square;
    std::uint64_t above_2 = 0, above_3 = 0;
    each_counted(pair, [&](std::size_t i, int y) {
        for (int c = 0; c < 3; ++c) {
            const double d = pair.difference(c, i);
            const double variance = pair.variance(c, i);
            if (!(variance > 0)) {
                m.z_unknown += d < 0 || d > 0 ? 1 : 0;
                continue;
            }
            const double z2 = d * d / variance;
            ++m.z_count;
            above_2 += z2 > 4 ? 1 : 0;
            above_3 += z2 > 9 ? 1 : 0;
            square.add(z2, y);
        }
    });
    if (m.z_count == 0) return;
    m.z_above_2 = double(above_2) / double(m.z_count);
    m.z_above_3 = double(above_3) / double(m.z_count);
    m.z_square_mean = square.value() / double(m.z_count);
}

/// Index of the percentile among `count` sorted values: the least that `share` of them reach.
std::size_t rank_of(double share, std::size_t count) {
    const auto rank = std::size_t(std::ceil(share * double(count)));
    return std::min(std::max<std::size_t>(rank, 1), count) - 1;
}

/// Fills `values` by `term(channel, pixel)` over the counted pixels, in order.
template <class Function>
void fill(const PicturePair& pair, Span<float> values, Function&& term) {
    std::size_t at = 0;
    each_counted(pair, [&](std::size_t i, int) {
        for (int c = 0; c < 3; ++c) values[at++] = float(term(c, i));
    });
}

/// Selects only: the order that a library leaves the other values in reaches no result.
float percentile(Span<float> values) {
    float* nth = values.data + rank_of(kPercentile, values.size);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

Status add_percentiles(const PicturePair& pair, double epsilon, Metrics& m) {
    Buffer<float> buffer;
    PILEUS_TRY(buffer.resize(3 * m.cloud_pixels, "differences of pictures"));
    const Span<float> values = buffer.span();
    fill(pair, values, [&](int c, std::size_t i) { return std::fabs(pair.difference(c, i)); });
    m.percentile_999 = double(percentile(values));

    const auto ratio = [&](int c, std::size_t i) {
        const double d = pair.difference(c, i);
        return relative(d * d, pair.square(c, i), epsilon);
    };
    fill(pair, values, ratio);
    const float edge = percentile(values);
    m.relative_percentile_999 = std::sqrt(double(edge));

    // Keep the terms below the edge, and as many at the edge as are still missing.
    const std::size_t kept = rank_of(kPercentile, values.size) + 1;
    std::size_t below = 0;
    RowSum sum;
    each_counted(pair, [&](std::size_t i, int y) {
        for (int c = 0; c < 3; ++c) {
            const double term = ratio(c, i);
            if (float(term) >= edge) continue;
            ++below;
            sum.add(term, y);
        }
    });
    m.relmse_trimmed = (sum.value() + double(kept - below) * double(edge)) / double(kept);
    return Status::ok();
}

/// `halves`: those that the reference was merged from, or null.
Status compare_pair(const Image& a, const Image& reference, const Image* const* halves,
                    const MetricOptions& options, Metrics& metrics) {
    metrics = Metrics();
    PicturePair pair;
    SmoothSquares smooth;
    PILEUS_TRY(pair_pictures(a, reference, options.alpha_least, pair));
    if (halves != nullptr) PILEUS_TRY(smooth_squares(*halves[0], *halves[1], pair, smooth));
    metrics.has_alpha = pair.alpha != nullptr;
    metrics.has_error_a = pair.a_error[0] != nullptr;
    metrics.has_error_reference = pair.r_error[0] != nullptr;
    count_and_mean(pair, metrics);
    if (metrics.cloud_pixels == 0)
        return Status::bad_input(
            "compare: pixels: none to compare, 0, allowed: at least one finite pixel with alpha "
            "above the least");
    const double scale = 0.01 * metrics.mean_reference, epsilon = scale * scale;
    add_errors(pair, epsilon, metrics);
    add_bias_error(pair, metrics);
    add_z(pair, metrics);
    PILEUS_TRY(add_percentiles(pair, epsilon, metrics));
    if (!options.flip) return Status::ok();
    FlipOptions view;
    view.hdr = !(a.display_colours && reference.display_colours);
    view.threads = options.threads;
    FlipResult result;
    PILEUS_TRY(flip(a, reference, view, result));
    metrics.flip_mean = result.mean;
    return Status::ok();
}

}  // namespace

Status compare_images(const Image& a, const Image& reference, const MetricOptions& options,
                      Metrics& metrics) {
    return compare_pair(a, reference, nullptr, options, metrics);
}

Status compare_with_halves(const Image& a, const Image& half1, const Image& half2,
                           const MetricOptions& options, Metrics& metrics) {
    Image reference;
    PILEUS_TRY(merge_halves(half1, half2, reference));
    const Image* const halves[2] = {&half1, &half2};
    PILEUS_TRY(compare_pair(a, reference, halves, options, metrics));
    metrics.z_count = metrics.z_unknown = 0;
    metrics.z_above_2 = metrics.z_above_3 = metrics.z_square_mean = 0;
    return Status::ok();
}

}  // namespace pileus
