// SPDX-License-Identifier: Apache-2.0
// Least squares and interpolation through points of error against time.
// in: points -> out: see study_fit.h.
// docs/study.md, "Analysis"
#include "tools/study/study_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pileus {

namespace {

/// What a law of one term for the noise leaves unexplained, as a share of the error.
constexpr double kModelError = 0.03;

constexpr double kFloorSpan = 32;

double weight(const ErrorPoint& point) {
    const double model = kModelError * point.error;
    return 1 / (point.standard_error * point.standard_error + model * model);
}

/// The points of positive error behind `fixed_s`, in order of time, with `fixed_s` taken off their
/// times; of these the last three and all within a factor `span` of the last.
std::vector<ErrorPoint> dearest(Span<const ErrorPoint> points, double fixed_s, double span) {
    std::vector<ErrorPoint> kept;
    for (ErrorPoint p : points) {
        p.time_s -= fixed_s;
        if (p.error > 0 && p.time_s > 0) kept.push_back(p);
    }
    while (kept.size() > 3 && kept.front().time_s * span * (1 + 1e-9) < kept.back().time_s)
        kept.erase(kept.begin());
    return kept;
}

}  // namespace

TimeLaw fit_time(Span<const double> amounts, Span<const double> times) {
    TimeLaw law;
    double s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < amounts.size; ++i) {
        const double w = 1 / (times[i] * times[i]);
        s += w;
        sx += w * amounts[i];
        sy += w * times[i];
        sxx += w * amounts[i] * amounts[i];
        sxy += w * amounts[i] * times[i];
        least = std::min(least, times[i]);
    }
    const double determinant = s * sxx - sx * sx;
    if (amounts.size < 2 || !(determinant > 1e-12 * s * sxx)) return law;
    const double intercept = (sxx * sy - sx * sxy) / determinant;
    // Held at an end, the slope is fitted again for what is left.
    law.fixed_s = std::min(std::max(intercept, 0.0), least);
    law.per_amount_s = (sxy - law.fixed_s * sx) / sxx;
    law.known = law.per_amount_s > 0;
    return law;
}

FloorFit fit_floor(Span<const ErrorPoint> points, double fixed_s) {
    FloorFit fit;
    fit.fixed_s = fixed_s;
    const std::vector<ErrorPoint> used = dearest(points, fixed_s, kFloorSpan);
    // Normal equations of error = floor + noise x with x = 1/time.
    double s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const ErrorPoint& p : used) {
        const double w = weight(p), x = 1 / p.time_s;
        s += w;
        sx += w * x;
        sy += w * p.error;
        sxx += w * x * x;
        sxy += w * x * p.error;
    }
    const double determinant = s * sxx - sx * sx;
    if (used.size() < 2 || !(determinant > 0)) return fit;
    fit.known = true;
    fit.floor = (sxx * sy - sx * sxy) / determinant;
    fit.noise_s = (s * sxy - sx * sy) / determinant;
    double misfit = 0;
    for (const ErrorPoint& p : used) {
        const double rest = p.error - fit.floor - fit.noise_s / p.time_s;
        misfit += weight(p) * rest * rest;
    }
    fit.noise_alone_s = sxy / sxx;
    const double free = double(used.size()) - 2;
    fit.floor_error = std::sqrt(sxx / determinant * std::max(1.0, free > 0 ? misfit / free : 1.0));
    if (fit.floor < 0) {
        fit.floor = 0;
        fit.noise_s = sxy / sxx;
    } else if (fit.noise_s < 0) {
        fit.noise_s = 0;
        fit.floor = sy / s;
    }
    return fit;
}

double fitted_error(const FloorFit& fit, double time_s) {
    if (!(time_s > fit.fixed_s)) return std::numeric_limits<double>::infinity();
    return fit.floor + fit.noise_s / (time_s - fit.fixed_s);
}

SlopeFit fit_slope(Span<const ErrorPoint> points, double fixed_s) {
    const std::vector<ErrorPoint> kept = dearest(points, fixed_s, 10);
    SlopeFit fit;
    if (kept.size() < 2) return fit;
    const double n = double(kept.size());
    double mean_x = 0, mean_y = 0, sxx = 0, sxy = 0, rest = 0;
    for (const ErrorPoint& p : kept) {
        mean_x += std::log(p.time_s) / n;
        mean_y += std::log(p.error) / n;
    }
    for (const ErrorPoint& p : kept) {
        const double x = std::log(p.time_s) - mean_x, y = std::log(p.error) - mean_y;
        sxx += x * x;
        sxy += x * y;
    }
    if (!(sxx > 0)) return fit;
    fit.known = true;
    fit.points = int(kept.size());
    fit.slope = sxy / sxx;
    for (const ErrorPoint& p : kept) {
        const double x = std::log(p.time_s) - mean_x, y = std::log(p.error) - mean_y;
        rest += (y - fit.slope * x) * (y - fit.slope * x);
    }
    if (kept.size() > 2) fit.standard_error = std::sqrt(rest / (n - 2) / sxx);
    return fit;
}

TimeTo time_to(Span<const ErrorPoint> points, const FloorFit& fit, double target) {
    TimeTo result;
    // Behind the last point above the target the error stays below it.
    std::size_t first = points.size;
    while (first > 0 && points[first - 1].error <= target) --first;
    if (points.empty()) return result;
    if (first == 0) return {TimeKind::kAtMost, points[0].time_s, 0};
    if (first < points.size) {
        const ErrorPoint &a = points[first - 1], &b = points[first];
        // A point whose error is lost in the reference's noise only tells that it is below.
        if (!(b.error > 0)) return {TimeKind::kInterpolated, b.time_s, 0};
        const double share = std::log(a.error / target) / std::log(a.error / b.error);
        const double time = a.time_s * std::pow(b.time_s / a.time_s, share);
        return {TimeKind::kInterpolated, time, 0};
    }
    if (!fit.known) return result;
    const double floor = fit.found() ? fit.floor : 0;
    const double noise = fit.found() ? fit.noise_s : fit.noise_alone_s;
    if (fit.found() && fit.floor - 2 * fit.floor_error >= target)
        return {TimeKind::kNever, 0, fit.floor};
    if (fit.found() && fit.floor + 2 * fit.floor_error >= target)
        return {TimeKind::kDoubtful, 0, fit.floor};
    result = {TimeKind::kExtrapolated, fit.fixed_s + noise / (target - floor), 0};
    result.time_s = std::max(result.time_s, points[points.size - 1].time_s);
    return result;
}

std::vector<bool> pareto_front(Span<const ErrorPoint> points) {
    std::vector<bool> front(points.size, true);
    for (std::size_t i = 0; i < points.size; ++i)
        for (std::size_t j = 0; j < points.size; ++j) {
            const ErrorPoint &a = points[i], &b = points[j];
            const bool as_good = b.time_s <= a.time_s && b.error <= a.error;
            const bool better = b.time_s < a.time_s || b.error < a.error;
            if (as_good && better) front[i] = false;
        }
    return front;
}

double student_95(int degrees) {
    constexpr double kTable[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                                 2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131};
    constexpr int kCount = int(sizeof kTable / sizeof kTable[0]);
    if (degrees <= kCount) return kTable[degrees < 1 ? 0 : degrees - 1];
    // Cornish and Fisher's first terms: within 0.001 from here on.
    const double z = 1.959964, d = degrees;
    return z + (z * z * z + z) / (4 * d) +
           (5 * z * z * z * z * z + 16 * z * z * z + 3 * z) / (96 * d * d);
}

}  // namespace pileus
