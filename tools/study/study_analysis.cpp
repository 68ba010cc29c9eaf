// SPDX-License-Identifier: Apache-2.0
// Measures every picture against its reference and fits laws to what comes out.
// in: records and pictures -> out: StudyResult.
// docs/study.md, "Analysis"
#include "tools/study/study_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/compare/flip.h"
#include "lab/compare/metrics.h"
#include "src/io/images/image_file.h"

namespace pileus {

namespace {

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

class Analyst {
public:
    Analyst(const Study& study, const std::vector<StudyRun>& runs,
            const std::vector<RunRecord>& records, StudyResult& result)
        : study_(study), runs_(runs), records_(records), result_(result) {}

    Status analyse() {
        count();
        for (std::size_t s = 0; s < study_.scenes.size(); ++s) {
            const StudyScene& scene = study_.scenes[s];
            if (!scene.skipped.empty()) {
                result_.faults.push_back("scene " + scene.name + " left out: " + scene.skipped);
                continue;
            }
            if (find(int(s), -1, 0, 0) == nullptr) continue;
            SceneResult one;
            one.scene = int(s);
            Status status = measure_scene(one);
            if (status.code == Code::kLimit) return status;
            if (!status) one.fault = status.message;
            result_.scenes.push_back(std::move(one));
        }
        return Status::ok();
    }

private:
    void count() {
        for (std::size_t i = 0; i < runs_.size(); ++i) {
            const RunRecord& record = records_[i];
            const bool reference = runs_[i].is_reference();
            (reference ? result_.references_cpu_s : result_.runs_cpu_s) += record.cpu_s;
            (reference ? result_.references_wall_s : result_.runs_wall_s) += record.wall_s;
            if (record.fault.empty()) continue;
            ++result_.failed;
            std::string words;
            for (const std::string& word : runs_[i].words) words += ' ' + word;
            result_.faults.push_back(fmt::format("run failed, {}: pileus{}", record.fault, words));
        }
    }

    const StudyRun* find(int scene, int curve, int budget, int repeat) const {
        for (const StudyRun& run : runs_)
            if (run.scene == scene && run.curve == curve && run.budget == budget &&
                run.repeat == repeat)
                return &run;
        return nullptr;
    }
    const RunRecord& record_of(const StudyRun& run) const {
        return records_[std::size_t(&run - runs_.data())];
    }

    Status measure_scene(SceneResult& scene) {
        Image halves[2];
        for (int h = 0; h < 2; ++h) {
            const StudyRun* run = find(scene.scene, -1, 0, h);
            if (run == nullptr || !record_of(*run).done)
                return Status::io("no reference: its run failed");
            scene.half[h] = record_of(*run);
            scene.half_image[h] = run->image;
            scene.half_hash[h] = scene.half[h].hash;
            PILEUS_TRY(read_image(run->image, halves[h]));
        }
        PILEUS_TRY(reference_noise(halves[0], halves[1], scene.reference));
        for (std::size_t c = 0; c < study_.curves.size(); ++c) {
            CurveResult curve;
            curve.curve = int(c);
            for (std::size_t b = 0; b < study_.curves[c].budgets.size(); ++b) {
                StudyPoint point;
                point.budget = int(b);
                PILEUS_TRY(measure_point(scene.scene, int(c), halves, point));
                if (point.seeds > 0) curve.points.push_back(std::move(point));
            }
            if (curve.points.empty()) continue;
            fit_curve(study_.targets, curve);
            scene.curves.push_back(std::move(curve));
        }
        choose_curves(scene);
        return Status::ok();
    }

    Status measure_point(int scene, int curve, const Image (&halves)[2], StudyPoint& point) {
        std::vector<Image> pictures;
        std::vector<double> wall, cpu, render;
        point.budget_text = study_.curves[std::size_t(curve)].budgets[std::size_t(point.budget)];
        for (int repeat = 0; repeat < study_.seeds; ++repeat) {
            const StudyRun* run = find(scene, curve, point.budget, repeat);
            if (run == nullptr || !record_of(*run).done) continue;
            const RunRecord& record = record_of(*run);
            pictures.emplace_back();
            PILEUS_TRY(read_image(run->image, pictures.back()));
            if (point.seeds == 0) point.image = run->image;
            ++point.seeds;
            point.amount = run->amount;
            wall.push_back(record.wall_s);
            cpu.push_back(record.cpu_s);
            render.push_back(record.render_cpu_s);
            point.peak_bytes = std::max(point.peak_bytes, record.peak_bytes);
            point.photons = record.photons;
            point.scatterings = record.scatterings;
        }
        if (point.seeds == 0) return Status::ok();
        point.wall_s = median(wall);
        point.cpu_s = median(cpu);
        point.render_cpu_s = median(render);
        point.cpu_least_s = *std::min_element(cpu.begin(), cpu.end());
        point.cpu_most_s = *std::max_element(cpu.begin(), cpu.end());
        PILEUS_TRY(split_error(pictures, halves[0], halves[1], point.error));
        if (point.error.relmse > 0 && point.cpu_s > 0)
            point.merit = 1 / (point.error.relmse * point.cpu_s);
        return add_pictures_errors(pictures[0], halves, point);
    }

    /// RMSE and FLIP of the first seed's picture.
    Status add_pictures_errors(const Image& picture, const Image (&halves)[2], StudyPoint& point) {
        Metrics metrics;
        PILEUS_TRY(compare_with_halves(picture, halves[0], halves[1], MetricOptions(), metrics));
        point.rmse = metrics.rmse;
        Image reference;
        FlipResult eye;
        PILEUS_TRY(merge_halves(halves[0], halves[1], reference));
        PILEUS_TRY(flip(picture, reference, FlipOptions(), eye));
        point.flip_mean = eye.mean;
        point.flip_99 = eye.percentile_99;
        return Status::ok();
    }

    const Study& study_;
    const std::vector<StudyRun>& runs_;
    const std::vector<RunRecord>& records_;
    StudyResult& result_;
};

}  // namespace

void fit_curve(const std::array<double, 2>& targets, CurveResult& curve) {
    std::vector<ErrorPoint> points, smooth;
    std::vector<double> amounts, times;
    for (const StudyPoint& point : curve.points) {
        amounts.push_back(point.amount);
        times.push_back(point.cpu_s);
        curve.merit = std::max(curve.merit, point.merit);
    }
    curve.time = fit_time({amounts.data(), amounts.size()}, {times.data(), times.size()});
    for (const StudyPoint& point : curve.points) {
        points.push_back(point.measured());
        // One seed has no standard error; the law's own error remains.
        if (!(points.back().standard_error >= 0)) points.back().standard_error = 0;
        // The error follows the work, which is known exactly, not the clock, which is disturbed.
        smooth.push_back(points.back());
        if (curve.time.known)
            smooth.back().time_s = curve.time.fixed_s + curve.time.per_amount_s * point.amount;
    }
    const auto earlier = [](const ErrorPoint& a, const ErrorPoint& b) {
        return a.time_s < b.time_s;
    };
    std::sort(points.begin(), points.end(), earlier);
    const Span<const ErrorPoint> measured{points.data(), points.size()};
    const Span<const ErrorPoint> by_law{smooth.data(), smooth.size()};
    const double fixed = curve.time.known ? curve.time.fixed_s : 0;
    curve.fit = fit_floor(by_law, fixed);
    curve.slope = fit_slope(by_law, fixed);
    const ErrorSplit& last = curve.points.back().error;
    for (std::size_t i = 0; i < 2; ++i) {
        TimeTo& to = curve.to_target[i];
        to = time_to(measured, curve.fit, targets[i]);
        // The bias that the dearest point's seeds share is a floor too, found without a law.
        const bool foretold = to.kind == TimeKind::kExtrapolated || to.kind == TimeKind::kDoubtful;
        if (foretold && last.bias2 - 2 * last.bias2_error >= targets[i])
            to = {TimeKind::kNever, 0, last.bias2};
    }
}

Status analyse_study(const Study& study, const std::vector<StudyRun>& runs,
                     const std::vector<RunRecord>& records, StudyResult& result) {
    return Analyst(study, runs, records, result).analyse();
}

}  // namespace pileus
