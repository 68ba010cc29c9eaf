// SPDX-License-Identifier: Apache-2.0
// What the runs of a study tell: errors, laws through them, which method when.
// in: runs, records, pictures on the disk -> out: StudyResult, all numbers of the report.
// docs/study.md, "Analysis"
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "tools/study/study_fit.h"
#include "tools/study/study_runs.h"
#include "tools/study/study_split.h"

namespace pileus {

/// One setting with one budget on one scene: the median of its times, all seeds' errors.
struct StudyPoint {
    int budget = 0;
    std::string budget_text;
    double amount = 0;
    int seeds = 0;  ///< pictures there are
    double wall_s = 0, cpu_s = 0, cpu_least_s = 0, cpu_most_s = 0;
    double render_cpu_s = 0;  ///< of cpu_s, without reading and writing files
    double peak_bytes = 0;    ///< the most
    double photons = 0, scatterings = 0;
    ErrorSplit error;
    double rmse = 0;                                  ///< of the first seed, noise of both included
    double flip_mean = kUnknown, flip_99 = kUnknown;  ///< HDR-FLIP of the first seed's picture
    double merit = 0;                                 ///< 1/(relMSE CPU seconds); 0 where unknown
    bool pareto = false;
    std::string image;  ///< the first seed's

    static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    ErrorPoint measured() const { return {cpu_s, error.relmse, error.relmse_error}; }
};

struct CurveResult {
    int curve = 0;
    std::vector<StudyPoint> points;  ///< in order of their budgets
    TimeLaw time;
    FloorFit fit;
    SlopeFit slope;
    TimeTo to_target[2];
    double merit = 0;  ///< of the best point
};

/// Between two times, the curve whose law comes lowest; in order of time.
struct Advice {
    double from_s = 0, to_s = 0;
    int curve = 0;
    double error_from = 0, error_to = 0;  ///< relMSE by its law at both ends
};

struct SceneResult {
    int scene = 0;
    std::string fault;  ///< why there is no result; empty: there is one
    std::string half_image[2], half_hash[2];
    ReferenceNoise reference;
    RunRecord half[2];
    std::vector<CurveResult> curves;
    std::vector<Advice> advice;
};

/// The machine and program that made the pictures.
struct StudyMachine {
    std::string version, compiler, processor, isa;
    int processors = 0, threads = 0;
};

struct StudyResult {
    StudyMachine machine;
    std::vector<SceneResult> scenes;  ///< those that were asked for, in the study's order
    std::vector<std::string> faults;  ///< of runs that failed, and scenes left out
    int failed = 0;                   ///< runs
    double runs_cpu_s = 0, runs_wall_s = 0;
    double references_cpu_s = 0, references_wall_s = 0;
};

/// Reads the pictures and fills everything but `machine`. A scene whose reference is missing keeps
/// its fault; a point without a picture is left out. Errors: kLimit for memory.
Status analyse_study(const Study& study, const std::vector<StudyRun>& runs,
                     const std::vector<RunRecord>& records, StudyResult& result);

/// The laws of a curve whose points are known; `targets` are relMSE.
void fit_curve(const std::array<double, 2>& targets, CurveResult& curve);

/// Marks the Pareto points of a scene, and derives the advice from the curves' laws: from the least
/// to the greatest time measured, a curve counts from its own cheapest point on. Spans of less than
/// a tenth of an octave go to their neighbour.
void choose_curves(SceneResult& scene);

}  // namespace pileus
