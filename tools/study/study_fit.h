// SPDX-License-Identifier: Apache-2.0
// Laws through points of error against time: floor, slope, time to a target, Pareto front.
// in: times in seconds and errors (relMSE) -> out: plain numbers, with their standard errors.
// docs/study.md, "Analysis"
#pragma once
#include <cstddef>
#include <vector>

#include "src/base/span.h"

namespace pileus {

/// One measured point: time in seconds, mean error over the seeds, its standard error.
struct ErrorPoint {
    double time_s = 0, error = 0, standard_error = 0;
};

/// error = floor + slope_s/(time - fixed_s): a part that no time mends, and noise whose variance
/// falls with the work; what is prepared once takes `fixed_s`.
struct FloorFit {
    bool known = false;
    /// Whether the floor is told apart from 0.
    bool found() const { return known && floor > 2 * floor_error; }
    double floor = 0, floor_error = 0;  ///< >= 0; its standard error
    double noise_s = 0;                 ///< seconds at which the noise alone would be 1
    double noise_alone_s = 0;           ///< the same, fitted without a floor
    double fixed_s = 0;
};

/// time = fixed_s + per_amount_s * amount, by least squares weighted by 1/time^2; what does not
/// grow with the work is held to [0, the least time].
struct TimeLaw {
    bool known = false;  ///< false for fewer than two amounts, or times that do not grow
    double fixed_s = 0, per_amount_s = 0;
};
TimeLaw fit_time(Span<const double> amounts, Span<const double> times);

/// Weighted least squares over the dearest points of positive error: those within a factor of 32
/// of the last time behind fixed_s, at least three where there are as many, since the law holds
/// only where every pixel has met some light. Weights 1/(standard error^2 + (3 % of the error)^2);
/// where the points scatter more than that, floor_error grows with their scatter. A negative floor
/// or noise becomes 0 and the other is fitted again. Unknown below two points.
FloorFit fit_floor(Span<const ErrorPoint> points, double fixed_s);

/// Error that the fit foretells for a time; infinite up to fixed_s.
double fitted_error(const FloorFit& fit, double time_s);

/// d log(error) / d log(time - fixed_s) by least squares over the last decade of that time, at
/// least the last three points where there are as many; -1 for unbiased noise, 0 on the floor.
struct SlopeFit {
    bool known = false;
    double slope = 0, standard_error = 0;  ///< the latter 0 for two points
    int points = 0;
};
SlopeFit fit_slope(Span<const ErrorPoint> points, double fixed_s);

enum class TimeKind {
    kUnknown,       ///< no points, or no fit
    kInterpolated,  ///< between two points, straight in logarithms
    kAtMost,        ///< already the cheapest point is better
    kExtrapolated,  ///< by the fit, beyond the dearest point
    kNever,         ///< the fit's floor is above the target, by two standard errors
    kDoubtful       ///< the fit's floor cannot be told from the target
};
struct TimeTo {
    TimeKind kind = TimeKind::kUnknown;
    double time_s = 0;
    double floor = 0;  ///< what forbids it, for kNever and kDoubtful
};
/// Time until the error stays at or below `target` > 0. Points in order of time. A floor that is
/// not found is taken as none.
TimeTo time_to(Span<const ErrorPoint> points, const FloorFit& fit, double target);

/// True where no other point is at least as quick and at least as good, and better in one.
std::vector<bool> pareto_front(Span<const ErrorPoint> points);

/// Two-sided 95 % quantile of Student's distribution; `degrees` >= 1.
double student_95(int degrees);

}  // namespace pileus
