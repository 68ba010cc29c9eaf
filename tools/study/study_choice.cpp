// SPDX-License-Identifier: Apache-2.0
// Which curve of a scene to take for which time.
// in: points and laws -> out: marks on the Pareto front, advice.
// docs/study.md, "Analysis"
#include <algorithm>
#include <cmath>

#include "tools/study/study_analysis.h"

namespace pileus {

namespace {

constexpr int kStepsPerOctave = 20;
constexpr double kUseless = 0.25;                 // a typical error of half the radiance
constexpr double kShortest = 1.0717734625362931;  // 2^(1/10)

/// The times between which a scene was measured.
bool find_range(const SceneResult& scene, double& low, double& high) {
    low = high = 0;
    for (const CurveResult& curve : scene.curves)
        for (const StudyPoint& point : curve.points) {
            if (!curve.fit.known || !(point.cpu_s > 0)) continue;
            low = low > 0 ? std::min(low, point.cpu_s) : point.cpu_s;
            high = std::max(high, point.cpu_s);
        }
    return high > low;
}

/// The curve whose law is lowest at a time; null where none is of use.
const CurveResult* best_at(const SceneResult& scene, double time_s) {
    const CurveResult* best = nullptr;
    for (const CurveResult& curve : scene.curves) {
        if (!curve.fit.known || curve.points.empty()) continue;
        double first = curve.points[0].cpu_s;
        for (const StudyPoint& point : curve.points) first = std::min(first, point.cpu_s);
        if (time_s < first * (1 - 1e-9)) continue;
        const double error = fitted_error(curve.fit, time_s);
        if (!(error <= kUseless)) continue;
        if (best == nullptr || error < fitted_error(best->fit, time_s)) best = &curve;
    }
    return best;
}

void add_step(const CurveResult& curve, double from, double to, std::vector<Advice>& advice) {
    const double last = fitted_error(curve.fit, to);
    if (!advice.empty() && advice.back().curve == curve.curve) {
        advice.back().to_s = to;
        advice.back().error_to = last;
    } else {
        advice.push_back({from, to, curve.curve, fitted_error(curve.fit, from), last});
    }
}

const CurveResult& curve_of(const SceneResult& scene, int number) {
    for (const CurveResult& curve : scene.curves)
        if (curve.curve == number) return curve;
    return scene.curves[0];
}

void mark_front(SceneResult& scene) {
    std::vector<ErrorPoint> points;
    std::vector<StudyPoint*> places;
    for (CurveResult& curve : scene.curves)
        for (StudyPoint& point : curve.points) {
            points.push_back(point.measured());
            places.push_back(&point);
        }
    const std::vector<bool> front = pareto_front({points.data(), points.size()});
    for (std::size_t i = 0; i < places.size(); ++i) places[i]->pareto = front[i];
}

}  // namespace

void choose_curves(SceneResult& scene) {
    mark_front(scene);
    scene.advice.clear();
    double low = 0, high = 0;
    if (!find_range(scene, low, high)) return;
    const int steps = std::max(1, int(std::ceil(kStepsPerOctave * std::log2(high / low))));
    const double factor = std::pow(high / low, 1.0 / steps);
    std::vector<Advice> raw;
    for (int i = 0; i < steps; ++i) {
        const double from = low * std::pow(factor, i), to = from * factor;
        const CurveResult* best = best_at(scene, from);
        if (best != nullptr) add_step(*best, from, to, raw);
    }
    // A lead that lasts no longer than the laws are exact is none.
    for (const Advice& one : raw) {
        const bool brief = one.to_s < one.from_s * kShortest && !scene.advice.empty();
        const int curve = brief ? scene.advice.back().curve : one.curve;
        add_step(curve_of(scene, curve), one.from_s, one.to_s, scene.advice);
    }
}

}  // namespace pileus
