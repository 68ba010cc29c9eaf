// SPDX-License-Identifier: Apache-2.0
// Puts the fields of a Report under the names that outsiders may read.
// in: a Report -> out: JSON text, keys in a fixed order.
// RFC 8259; docs/report.md explains each key.
#define JSON_NOEXCEPTION 1
#include "src/plan/report_json.h"

#include <nlohmann/json.hpp>

namespace pileus {

namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json arrays_of(const Plan& plan) {
    Json rows = Json::array();
    for (const MemoryRow& row : plan.memory.rows())
        rows.push_back({{"item", row.item},
                        {"first", stage_name(row.first)},
                        {"last", stage_name(row.last)},
                        {"bytes", row.bytes}});
    return rows;
}

Json bounds_of(const Plan& plan) {
    Json rows = Json::array();
    for (const SumBound& b : plan.bounds)
        rows.push_back({{"sum", b.sum},
                        {"addends", b.addends},
                        {"largest", b.largest},
                        {"places", b.places},
                        {"worst", b.worst},
                        {"allowed", b.allowed}});
    return rows;
}

/// What is not known before the values are read is null.
Json known(bool is_known, double number) { return is_known ? Json(number) : Json(nullptr); }

Json work_of(const Plan& plan) {
    const WorkEstimate& work = plan.work;
    return {{"of", plan.work_of},
            {"photons", work.photons},
            {"scatterings_per_photon", known(work.known, work.scatterings_per_photon)},
            {"scatterings", known(work.known, work.scatterings)},
            {"law", work.law}};
}

Json limits_of(const Plan& plan) {
    Json rows = Json::object();
    for (const LimitUse& limit : plan.limits)
        rows[limit_row(limit.id).name] = {
            {"needs", limit.known ? Json(limit.needs) : Json(nullptr)}, {"allowed", limit.allowed}};
    return rows;
}

Json accumulation_of(const Accumulation& accumulation) {
    if (accumulation.kind.empty()) return nullptr;
    return {{"kind", accumulation.kind}, {"why", accumulation.why}};
}

Json plan_of(const Plan& plan) {
    Json left_out = Json::array(), bytes = Json::object(), stages = Json::object();
    for (std::size_t s = 0; s < kStageCount; ++s)
        if (plan.runs(Stage(s))) stages[stage_name(Stage(s))] = plan.memory.live(Stage(s));
    for (const LeftOut& part : plan.left_out)
        left_out.push_back({{"what", part.what}, {"why", part.why}});

    // Two arrays of one name share its line.
    for (const MemoryRow& row : plan.memory.rows()) {
        const std::uint64_t before = bytes.value(row.item, std::uint64_t{0});
        bytes[row.item] = before + row.bytes;
    }
    const BiasNote& bias = plan.bias;
    return {{"needed", plan.needed},
            {"left_out", left_out},
            {"exact", plan.exact},
            {"bytes", bytes},
            {"total_bytes", plan.memory.peak()},
            {"arrays", arrays_of(plan)},
            {"stages", stages},
            {"bounds", bounds_of(plan)},
            {"bias", {{"of", bias.method}, {"measured", bias.size}, {"page", bias.page}}},
            {"accumulation", accumulation_of(plan.accumulation)},
            {"work", work_of(plan)},
            {"limits", limits_of(plan)}};
}

Json time_of(const Clocks& clocks) {
    Json stages = Json::object();
    for (const StageTime& stage : clocks.stages) {
        const Json before = stages.value(stage.name, Json{{"wall_s", 0.0}, {"cpu_s", 0.0}});
        stages[stage.name] = {{"wall_s", before["wall_s"].get<double>() + stage.wall_s},
                              {"cpu_s", before["cpu_s"].get<double>() + stage.cpu_s}};
    }
    return {{"total_s", clocks.total_s},
            {"cpu_s", clocks.cpu_s},
            {"frame_wall_s", clocks.frame_wall_s},
            {"frame_cpu_s", clocks.frame_cpu_s},
            {"tracing_wall_s", clocks.tracing_wall_s},
            {"tracing_cpu_s", clocks.tracing_cpu_s},
            {"stages", stages}};
}

Json energy_of(const std::vector<EnergyRow>& energy) {
    Json rows = Json::array();
    for (const EnergyRow& row : energy)
        rows.push_back({{"light", row.light},
                        {"emitted", row.emitted},
                        {"top", row.top},
                        {"bottom", row.bottom},
                        {"sides", row.sides},
                        {"absorbed", row.absorbed},
                        {"ground", row.ground},
                        {"sky", row.sky},
                        {"terminated", row.terminated},
                        {"solid", row.solid},
                        {"direct_bottom", row.direct_bottom},
                        {"standard_error",
                         {{"top", row.error.top},
                          {"bottom", row.error.bottom},
                          {"sides", row.error.sides},
                          {"absorbed", row.error.absorbed}}},
                        {"balance_quanta", row.balance_quanta}});
    return rows;
}

/// Events per CPU second of tracing; null where no tracing was timed.
Json rate_of(std::uint64_t events, double cpu_s) {
    if (!(cpu_s > 0)) return nullptr;
    return double(events) / cpu_s;
}

Json error_of(const ErrorFigures& errors) {
    return {{"mean_relative", known(errors.known, errors.mean_relative)},
            {"rmse_estimate", known(errors.known, errors.rmse_estimate)},
            {"of", errors.of.empty() ? "none: the method has no noise" : errors.of}};
}

Json verify_of(const VerifyFigures& verify) {
    if (verify.pixels == 0) return nullptr;
    return {{"pixels", verify.pixels},
            {"samples_per_pixel", verify.samples},
            {"bias", verify.bias},
            {"standard_error", verify.standard_error},
            {"relmse", verify.relmse},
            {"noise", known(verify.has_errors, verify.noise)},
            {"bias_rms", known(verify.has_errors, verify.bias_rms)},
            {"within_1_sigma", known(verify.has_errors, verify.within[0])},
            {"within_2_sigma", known(verify.has_errors, verify.within[1])}};
}

Json ahead_of(const PathCounts& paths) {
    if (paths.ahead_pixels == 0) return nullptr;
    return {{"pixels", paths.ahead_pixels}, {"samples", paths.ahead_samples}};
}

Json ring_of(const PhotonCounts& photons) {
    if (photons.ring_whole == 0) return nullptr;
    return {{"generations", photons.ring_generations}, {"whole", photons.ring_whole}};
}

Json clouds_of(const CloudCounts& clouds) {
    if (clouds.kinds.empty() && clouds.layers.empty()) return nullptr;
    Json kinds = Json::array(), layers = Json::array();
    for (const CloudKindCount& kind : clouds.kinds)
        kinds.push_back({{"name", kind.name},
                         {"scene", kind.scene},
                         {"method", kind.method},
                         {"clouds", kind.clouds}});
    for (const CloudKindCount& layer : clouds.layers)
        layers.push_back({{"name", layer.name}, {"scene", layer.scene}, {"method", layer.method}});
    return {{"kinds", kinds},
            {"layers", layers},
            {"weather", clouds.notes},
            {"clouds", clouds.clouds},
            {"visible", clouds.visible},
            {"marched", clouds.marched},
            {"shown", clouds.shown},
            {"captured", clouds.captured},
            {"lit", clouds.lit},
            {"marched_pixels", clouds.marched_pixels},
            {"captured_pixels", clouds.captured_pixels},
            {"worst_px", clouds.worst_px}};
}

Json frame_work_of(const PictureHead& head) {
    const FrameWork& work = head.frame_work;
    return {{"scale", work.scale},     {"temporal", work.temporal},
            {"steps", work.steps},     {"light_refresh", work.light_refresh},
            {"photons", work.photons}, {"light", head.light_rule}};
}

Json light_of(const SweepCheck& sweep, const OrdinateFigures& ordinates) {
    Json difference;
    if (sweep.nodes > 0)
        difference = {{"nodes", sweep.nodes},
                      {"rms", sweep.rms},
                      {"largest", sweep.largest},
                      {"mean", sweep.mean}};
    Json solved;
    if (ordinates.nodes > 0)
        solved = {{"nodes", ordinates.nodes},
                  {"iterations", ordinates.iterations},
                  {"residual", ordinates.residual},
                  {"node_depth", ordinates.node_depth}};
    return {{"buffer_difference", difference}, {"ordinates", solved}};
}

/// A later entry of one name replaces an earlier one.
template <class Pairs>
Json object_of(const Pairs& pairs) {
    Json object = Json::object();
    for (const auto& pair : pairs) object[std::string(pair.first)] = pair.second;
    return object;
}

/// Events that this run traced, beside those from a state file.
void add_rates(const Report& report, Json& json) {
    const double cpu_s = report.clocks.tracing_cpu_s;
    const std::uint64_t earlier = report.paths.earlier_scatterings;
    json["scatterings_per_second"] = rate_of(report.events.scatterings - earlier, cpu_s);
    json["photons_per_second"] = rate_of(report.photons.traced, cpu_s);
    json["paths_per_second"] = rate_of(report.paths.traced - report.paths.earlier, cpu_s);
}

void add_head(const RunHead& head, Json& json) {
    json["version"] = head.version;
    json["scene"] = head.scene;
    json["method"] = head.method;
    json["isa"] = head.isa;
    json["threads"] = head.threads;
    if (head.ranks > 1) json["ranks"] = head.ranks;
    json["team"] = head.team;
    json["seed"] = head.seed;
    json["overrides"] = head.overrides;
}

}  // namespace

std::string report_json(const Report& report) {
    Json json;
    add_head(report, json);
    json["frame"] = report.frame;
    json["first_frame"] = report.first_frame;
    json["budget"] = report.budget;
    json["budget_used"] = report.budget_used;
    json["show"] = report.show;
    json["layers"] = report.layers;
    json["hash"] = report.hash;
    json["plan"] = plan_of(report.plan);
    json["memory"] = {{"peak_bytes", report.clocks.peak_bytes}};
    json["time"] = time_of(report.clocks);

    json["interrupted"] = report.interrupted;
    json["photons"] = report.photons.traced;
    json["generations"] = report.photons.generations;
    json["paths"] = report.paths.traced;
    json["samples_per_pixel"] = report.paths.samples_per_pixel;
    json["ahead"] = ahead_of(report.paths);
    json["ring"] = ring_of(report.photons);
    json["frame_work"] = frame_work_of(report);
    json["scatterings"] = report.events.scatterings;
    json["tentative"] = report.events.tentative;
    json["crossings"] = report.events.crossings;
    json["shadow_rays"] = report.paths.shadow_rays;
    add_rates(report, json);
    json["mean_path_m"] = report.photons.mean_path_m;
    json["samples"] = report.prepared.samples;
    json["leaves"] = report.prepared.leaves;
    json["collectors"] = report.prepared.collectors;

    json["clouds"] = clouds_of(report.clouds);
    json["energy"] = energy_of(report.photons.energy);
    json["error"] = error_of(report.errors);
    json["verify"] = verify_of(report.verify);
    json["light"] = light_of(report.sweep, report.ordinates);
    json["warnings"] = report.warnings;
    json["counters"] = object_of(report.counters);
    json["executed"] = object_of(report.executed);
    json["digests"] = object_of(report.digests);
    return text_of(json);
}

std::string plan_json(const Report& report) {
    Json json;
    add_head(report, json);
    json["plan"] = plan_of(report.plan);
    const ForetoldTime& time = report.plan.foretold;
    if (time.total_s > 0)
        json["foretold_time"] = {{"total_s", time.total_s},
                                 {"first_frame_s", time.first_s},
                                 {"next_frame_s", time.next_s}};
    return text_of(json);
}

}  // namespace pileus
