// SPDX-License-Identifier: Apache-2.0
// The study's analysis on data whose floor, slope, noise and fixed time are known.
// in: synthetic points -> out: checks; exact data must come back to rounding.
// docs/study.md, "Analysis"
#include <doctest/doctest.h>

#include <cmath>

#include "tools/study/study_analysis.h"
#include "tools/study/study_fit.h"

using namespace pileus;

namespace {

// Least squares over a dozen doubles: a few hundred units in the last place.
constexpr double kRounding = 1e-9;

/// Error = floor + noise/amount, time = fixed + per * amount, for amounts in powers of four.
CurveResult curve_of(double floor, double noise, double fixed, double per, int count) {
    CurveResult curve;
    double amount = 1000;
    for (int i = 0; i < count; ++i, amount *= 4) {
        StudyPoint point;
        point.budget = i;
        point.amount = amount;
        point.seeds = 3;
        point.cpu_s = fixed + per * amount;
        point.error.relmse = floor + noise / amount;
        point.error.relmse_error = 0.01 * point.error.relmse;
        curve.points.push_back(point);
    }
    fit_curve({0.01, 0.001}, curve);
    return curve;
}

Span<const ErrorPoint> span(const std::vector<ErrorPoint>& points) {
    return {points.data(), points.size()};
}

}  // namespace

TEST_CASE("a known floor, noise and fixed time come back") {
    const CurveResult curve = curve_of(3e-3, 40, 0.2, 1e-6, 7);
    REQUIRE(curve.time.known);
    CHECK(curve.time.fixed_s == doctest::Approx(0.2).epsilon(kRounding));
    CHECK(curve.time.per_amount_s == doctest::Approx(1e-6).epsilon(kRounding));
    REQUIRE(curve.fit.known);
    CHECK(curve.fit.floor == doctest::Approx(3e-3).epsilon(kRounding));
    CHECK(curve.fit.noise_s == doctest::Approx(40 * 1e-6).epsilon(kRounding));
    CHECK(curve.fit.floor_error > 0);
    // Its law foretells the measured points.
    for (const StudyPoint& p : curve.points)
        CHECK(fitted_error(curve.fit, p.cpu_s) == doctest::Approx(p.error.relmse).epsilon(1e-8));
    CHECK(std::isinf(fitted_error(curve.fit, 0.2)));
}

TEST_CASE("pure noise has slope -1 and no floor, a floor alone slope 0") {
    const CurveResult noise = curve_of(0, 40, 0.1, 1e-6, 6);
    CHECK(noise.slope.slope == doctest::Approx(-1).epsilon(kRounding));
    CHECK(noise.slope.standard_error < kRounding);
    CHECK(std::fabs(noise.fit.floor) < 1e-12);
    const CurveResult floor = curve_of(0.02, 0, 0.1, 1e-6, 6);
    CHECK(std::fabs(floor.slope.slope) < kRounding);
    CHECK(floor.fit.floor == doctest::Approx(0.02).epsilon(kRounding));
    CHECK(std::fabs(floor.fit.noise_s) < 1e-12);
}

TEST_CASE("the slope is that of the last decade") {
    // Slope -2 before a second, -1 behind it.
    std::vector<ErrorPoint> points;
    for (double t : {0.01, 0.1}) points.push_back({t, 1 / (t * t), 0});
    for (double t : {1.0, 2.0, 4.0, 8.0}) points.push_back({t, 1 / t, 0});
    const SlopeFit fit = fit_slope(span(points), 0);
    CHECK(fit.points == 4);
    CHECK(fit.slope == doctest::Approx(-1).epsilon(kRounding));
    CHECK_FALSE(fit_slope({points.data(), 1}, 0).known);
}

TEST_CASE("disturbed clocks move no floor") {
    CurveResult curve = curve_of(3e-3, 40, 0.2, 1e-6, 6);
    const double disturbance[] = {1.2, 0.9, 1.1, 1.3, 0.95, 1.1};
    for (std::size_t i = 0; i < 6; ++i) curve.points[i].cpu_s *= disturbance[i];
    fit_curve({0.01, 0.001}, curve);
    CHECK(curve.fit.floor == doctest::Approx(3e-3).epsilon(kRounding));
}

TEST_CASE("time to a target: measured, foretold, never") {
    // relMSE 1/t + 0.003 at 10 to 160 s, for targets inside, beyond, below the floor and above.
    std::vector<ErrorPoint> points;
    for (double t = 10; t <= 160; t *= 2) points.push_back({t, 0.003 + 1 / t, 0});
    const FloorFit fit = fit_floor(span(points), 0);
    const TimeTo inside = time_to(span(points), fit, 0.05);
    CHECK(inside.kind == TimeKind::kInterpolated);
    // The straight line in logarithms lies above the curve 1/t + floor by under 1 %.
    CHECK(inside.time_s == doctest::Approx(1 / 0.047).epsilon(0.01));
    const TimeTo beyond = time_to(span(points), fit, 0.004);
    CHECK(beyond.kind == TimeKind::kExtrapolated);
    CHECK(beyond.time_s == doctest::Approx(1000).epsilon(1e-6));
    CHECK(time_to(span(points), fit, 0.002).kind == TimeKind::kNever);
    CHECK(time_to(span(points), fit, 0.5).kind == TimeKind::kAtMost);
    CHECK(time_to(span(points), fit, 0.5).time_s == 10);
    CHECK(time_to({}, fit, 0.5).kind == TimeKind::kUnknown);
    FloorFit doubtful = fit;
    doubtful.floor_error = 0.001;
    CHECK(time_to(span(points), doubtful, 0.002).kind == TimeKind::kDoubtful);
    CHECK(time_to(span(points), doubtful, 0.004).kind == TimeKind::kDoubtful);
    CHECK(time_to(span(points), doubtful, 0.0051).kind == TimeKind::kExtrapolated);
    // A floor that is not told from 0 is taken as none, so that an unbiased method keeps its law.
    doubtful.floor_error = 0.002;
    doubtful.noise_alone_s = 1.5;
    CHECK(time_to(span(points), doubtful, 0.001).kind == TimeKind::kExtrapolated);
    CHECK(time_to(span(points), doubtful, 0.001).time_s == doctest::Approx(1500));
    // A lucky point before a worse one does not count.
    points[0].error = 0.04;
    CHECK(time_to(span(points), fit, 0.05).time_s > 10);
}

TEST_CASE("a bias that the seeds share forbids what the law would foretell") {
    CurveResult curve = curve_of(0, 400, 0.2, 1e-6, 5);
    CHECK(curve.to_target[1].kind == TimeKind::kExtrapolated);
    curve.points.back().error.bias2 = 0.0015;
    curve.points.back().error.bias2_error = 0.0002;
    fit_curve({0.01, 0.001}, curve);
    CHECK(curve.to_target[1].kind == TimeKind::kNever);
    CHECK(curve.to_target[1].floor == 0.0015);
}

TEST_CASE("the Pareto front holds what nothing beats") {
    const std::vector<ErrorPoint> points = {{1, 0.5, 0},  {2, 0.1, 0},  {2, 0.2, 0},
                                            {3, 0.1, 0},  {4, 0.05, 0}, {0.5, 0.9, 0},
                                            {4, 0.05, 0}, {9, 0.06, 0}};
    const std::vector<bool> expected = {true, true, false, false, true, true, true, false};
    CHECK(pareto_front(span(points)) == expected);
}

TEST_CASE("the quantiles of Student's distribution") {
    CHECK(student_95(1) == 12.706);
    CHECK(student_95(2) == 4.303);
    CHECK(student_95(15) == 2.131);
    // Tables print three decimals.
    CHECK(std::fabs(student_95(16) - 2.120) < 1e-3);
    CHECK(std::fabs(student_95(30) - 2.042) < 1e-3);
    CHECK(std::fabs(student_95(1000) - 1.962) < 1e-3);
}

TEST_CASE("advice follows the laws that cross") {
    // Biased and quick against unbiased: 0.01 + 1e-3/t meets 0.02/t at t = 1.9.
    SceneResult scene;
    scene.curves.push_back(curve_of(0.01, 1, 0, 1e-3, 6));
    scene.curves.push_back(curve_of(0, 20, 0, 1e-3, 6));
    scene.curves[0].curve = 0;
    scene.curves[1].curve = 1;
    choose_curves(scene);
    REQUIRE(scene.advice.size() == 2);
    CHECK(scene.advice[0].curve == 0);
    CHECK(scene.advice[1].curve == 1);
    // Steps are a twentieth of an octave.
    CHECK(scene.advice[1].from_s == doctest::Approx(1.9).epsilon(0.04));
    CHECK(scene.curves[0].points[0].pareto);
    CHECK_FALSE(scene.curves[1].points[0].pareto);
    CHECK(scene.curves[1].points[5].pareto);
    // Where nothing is below 0.25 there is nothing to advise.
    for (CurveResult& curve : scene.curves)
        for (StudyPoint& point : curve.points) point.error.relmse *= 1e3;
    for (CurveResult& curve : scene.curves) fit_curve({0.01, 0.001}, curve);
    choose_curves(scene);
    REQUIRE(scene.advice.size() == 1);
    CHECK(scene.advice[0].error_from <= 0.25);
}
