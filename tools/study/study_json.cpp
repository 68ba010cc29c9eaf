// SPDX-License-Identifier: Apache-2.0
// Puts the results of a study under names that outsiders may read.
// in: StudyResult -> out: JSON text.
// RFC 8259; docs/study.md, "Output"
#define JSON_NOEXCEPTION 1
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/study/study_report.h"

namespace pileus {

namespace {

using Json = nlohmann::ordered_json;

/// null where a number is not known.
Json known(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

const char* kind_name(TimeKind kind) {
    switch (kind) {
        case TimeKind::kInterpolated:
            return "interpolated";
        case TimeKind::kAtMost:
            return "at most";
        case TimeKind::kExtrapolated:
            return "extrapolated";
        case TimeKind::kNever:
            return "never";
        case TimeKind::kDoubtful:
            return "doubtful";
        case TimeKind::kUnknown:
            break;
    }
    return "unknown";
}

Json point_json(const StudyPoint& point) {
    Json each = Json::array();
    for (const double one : point.error.each) each.push_back(known(one));
    return {{"budget", point.budget_text},
            {"seeds", point.seeds},
            {"wall_s", point.wall_s},
            {"cpu_s", point.cpu_s},
            {"cpu_least_s", point.cpu_least_s},
            {"cpu_most_s", point.cpu_most_s},
            {"rendering_cpu_s", point.render_cpu_s},
            {"peak_bytes", point.peak_bytes},
            {"photons", point.photons},
            {"scatterings", point.scatterings},
            {"relmse", known(point.error.relmse)},
            {"relmse_standard_error", known(point.error.relmse_error)},
            {"relmse_each_seed", each},
            {"bias_squared", known(point.error.bias2)},
            {"bias_squared_standard_error", known(point.error.bias2_error)},
            {"noise", known(point.error.noise)},
            {"mean_bias_relative", known(point.error.mean_bias)},
            {"rmse", known(point.rmse)},
            {"flip_mean", known(point.flip_mean)},
            {"flip_99", known(point.flip_99)},
            {"figure_of_merit", known(point.merit)},
            {"pareto", point.pareto}};
}

Json curve_json(const Study& study, const CurveResult& curve) {
    const StudyCurve& of = study.curves[std::size_t(curve.curve)];
    Json points = Json::array(), targets = Json::array();
    for (const StudyPoint& point : curve.points) points.push_back(point_json(point));
    for (std::size_t i = 0; i < 2; ++i) {
        const TimeTo& to = curve.to_target[i];
        const bool has = to.time_s > 0;
        targets.push_back({{"relmse", study.targets[i]},
                           {"cpu_s", has ? known(to.time_s) : Json(nullptr)},
                           {"how", kind_name(to.kind)}});
    }
    const bool fit = curve.fit.known, slope = curve.slope.known;
    return {{"name", of.name},
            {"title", of.title},
            {"set", of.sets},
            {"points", points},
            {"slope", slope ? known(curve.slope.slope) : Json(nullptr)},
            {"slope_standard_error", slope ? known(curve.slope.standard_error) : Json(nullptr)},
            {"floor", fit ? known(curve.fit.floor) : Json(nullptr)},
            {"floor_standard_error", fit ? known(curve.fit.floor_error) : Json(nullptr)},
            {"cpu_s_per_amount", curve.time.known ? known(curve.time.per_amount_s) : Json(nullptr)},
            {"noise_seconds", fit ? known(curve.fit.noise_s) : Json(nullptr)},
            {"fixed_cpu_s", fit ? known(curve.fit.fixed_s) : Json(nullptr)},
            {"figure_of_merit", known(curve.merit)},
            {"time_to", targets}};
}

Json scene_json(const Study& study, const SceneResult& scene) {
    const StudyScene& of = study.scenes[std::size_t(scene.scene)];
    Json json = {{"name", of.name}, {"title", of.title}, {"file", of.file}, {"set", of.sets}};
    if (!scene.fault.empty()) {
        json["fault"] = scene.fault;
        return json;
    }
    json["reference"] = {{"budget_of_a_half", of.reference_budget},
                         {"hashes", {scene.half_hash[0], scene.half_hash[1]}},
                         {"cpu_s", scene.half[0].cpu_s + scene.half[1].cpu_s},
                         {"wall_s", scene.half[0].wall_s + scene.half[1].wall_s},
                         {"earlier", scene.half[0].earlier && scene.half[1].earlier},
                         {"noise", known(scene.reference.noise)},
                         {"resolution", known(scene.reference.resolution)},
                         {"mean_radiance", known(scene.reference.mean)},
                         {"cloud_pixels", scene.reference.cloud_pixels}};
    json["curves"] = Json::array();
    for (const CurveResult& curve : scene.curves)
        json["curves"].push_back(curve_json(study, curve));
    json["advice"] = Json::array();
    for (const Advice& advice : scene.advice)
        json["advice"].push_back({{"from_cpu_s", advice.from_s},
                                  {"to_cpu_s", advice.to_s},
                                  {"curve", study.curves[std::size_t(advice.curve)].name},
                                  {"relmse_from", known(advice.error_from)},
                                  {"relmse_to", known(advice.error_to)}});
    return json;
}

}  // namespace

std::string study_json(const Study& study, const StudyResult& result) {
    const StudyMachine& m = result.machine;
    Json json;
    json["title"] = study.title;
    json["version"] = m.version;
    json["machine"] = {{"processor", m.processor},
                       {"processors", m.processors},
                       {"threads", m.threads},
                       {"isa", m.isa},
                       {"compiler", m.compiler}};
    json["seeds"] = Json::array();
    for (int i = 0; i < study.seeds; ++i) json["seeds"].push_back(study.first_seed + i);
    json["reference"] = {{"set", study.reference.sets},
                         {"seeds", {study.reference.first_seed, study.reference.first_seed + 1}}};
    json["runs"] = {{"cpu_s", result.runs_cpu_s},
                    {"wall_s", result.runs_wall_s},
                    {"failed", result.failed},
                    {"references_cpu_s", result.references_cpu_s},
                    {"references_wall_s", result.references_wall_s}};
    json["left_out"] = result.faults;
    json["scenes"] = Json::array();
    for (const SceneResult& scene : result.scenes)
        json["scenes"].push_back(scene_json(study, scene));
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace pileus
