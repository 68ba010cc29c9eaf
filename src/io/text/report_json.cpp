// SPDX-License-Identifier: Apache-2.0
// Puts the fields of a Report under the names that outsiders may read.
// in: a Report -> out: JSON text, keys in a fixed order.
// RFC 8259; docs/report.md explains each key.
#define JSON_NOEXCEPTION 1
#include "src/io/text/report_json.h"

#include <nlohmann/json.hpp>

#include "src/base/file.h"

namespace pileus {

namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json arrays_of(const Report& report) {
    Json rows = Json::array();
    for (const ReportBytes& item : report.bytes)
        rows.push_back({{"item", item.item},
                        {"first", item.first},
                        {"last", item.last},
                        {"bytes", item.bytes}});
    return rows;
}

Json bounds_of(const Report& report) {
    Json rows = Json::array();
    for (const ReportBound& b : report.bounds)
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

Json work_of(const ReportWork& work) {
    return {{"of", work.of},
            {"photons", work.photons},
            {"scatterings_per_photon", known(work.known, work.scatterings_per_photon)},
            {"scatterings", known(work.known, work.scatterings)},
            {"law", work.law}};
}

Json limits_of(const Report& report) {
    Json rows = Json::object();
    for (const ReportLimit& limit : report.limits)
        rows[limit.name] = {{"needs", limit.known ? Json(limit.needs) : Json(nullptr)},
                            {"allowed", limit.allowed}};
    return rows;
}

Json plan_of(const Report& report) {
    Json left_out = Json::array(), bytes = Json::object(), stages = Json::object();
    for (const ReportStage& stage : report.stage_bytes) stages[stage.stage] = stage.bytes;
    for (const ReportLeftOut& part : report.left_out)
        left_out.push_back({{"what", part.what}, {"why", part.why}});

    // Two arrays of one name share its line.
    for (const ReportBytes& item : report.bytes) {
        const std::uint64_t before = bytes.value(item.item, std::uint64_t{0});
        bytes[item.item] = before + item.bytes;
    }
    return {
        {"needed", report.needed},
        {"left_out", left_out},
        {"exact", report.exact},
        {"bytes", bytes},
        {"total_bytes", report.total_bytes},
        {"arrays", arrays_of(report)},
        {"stages", stages},
        {"bounds", bounds_of(report)},
        {"bias", {{"of", report.bias_of}, {"measured", report.bias}, {"page", report.bias_page}}},
        {"accumulation", report.accumulation.empty() ? Json(nullptr)
                                                     : Json({{"kind", report.accumulation},
                                                             {"why", report.accumulation_why}})},
        {"work", work_of(report.work)},
        {"limits", limits_of(report)}};
}

Json time_of(const Report& report) {
    Json stages = Json::object();
    for (const StageTime& stage : report.stages) {
        const Json before = stages.value(stage.name, Json{{"wall_s", 0.0}, {"cpu_s", 0.0}});
        stages[stage.name] = {{"wall_s", before["wall_s"].get<double>() + stage.wall_s},
                              {"cpu_s", before["cpu_s"].get<double>() + stage.cpu_s}};
    }
    return {{"total_s", report.total_s},
            {"cpu_s", report.cpu_s},
            {"frame_wall_s", report.frame_wall_s},
            {"frame_cpu_s", report.frame_cpu_s},
            {"tracing_wall_s", report.tracing_wall_s},
            {"tracing_cpu_s", report.tracing_cpu_s},
            {"stages", stages}};
}

Json energy_of(const Report& report) {
    Json rows = Json::array();
    for (const EnergyRow& row : report.energy)
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
                         {{"top", row.top_error},
                          {"bottom", row.bottom_error},
                          {"sides", row.sides_error},
                          {"absorbed", row.absorbed_error}}},
                        {"balance_quanta", row.balance_quanta}});
    return rows;
}

/// Events per CPU second of tracing; null where no tracing was timed.
Json rate_of(std::uint64_t events, double cpu_s) {
    if (!(cpu_s > 0)) return nullptr;
    return double(events) / cpu_s;
}

Json error_of(const Report& report) {
    if (!report.has_error) return {{"mean_relative", nullptr}, {"rmse_estimate", nullptr}};
    return {{"mean_relative", report.mean_relative}, {"rmse_estimate", report.rmse_estimate}};
}

Json verify_of(const Report& report) {
    if (report.verified_pixels == 0) return nullptr;
    return {{"pixels", report.verified_pixels},
            {"samples_per_pixel", report.verified_samples},
            {"bias", report.verify_bias},
            {"standard_error", report.verify_standard_error},
            {"relmse", report.verify_relmse}};
}

Json ahead_of(const Report& report) {
    if (report.ahead_pixels == 0) return nullptr;
    return {{"pixels", report.ahead_pixels}, {"samples", report.ahead_samples}};
}

Json ring_of(const Report& report) {
    if (report.ring_whole == 0) return nullptr;
    return {{"generations", report.ring_generations}, {"whole", report.ring_whole}};
}

Json clouds_of(const ReportClouds& clouds) {
    if (clouds.kinds.empty()) return nullptr;
    Json kinds = Json::array();
    for (const ReportCloudKind& kind : clouds.kinds)
        kinds.push_back({{"name", kind.name},
                         {"scene", kind.scene},
                         {"method", kind.method},
                         {"clouds", kind.clouds}});
    return {{"kinds", kinds},
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

Json frame_work_of(const ReportFrameWork& work) {
    return {{"scale", work.scale},     {"temporal", work.temporal},
            {"steps", work.steps},     {"light_refresh", work.light_refresh},
            {"photons", work.photons}, {"light", work.light}};
}

Json light_of(const Report& report) {
    Json difference;
    if (report.buffer_nodes > 0)
        difference = {{"nodes", report.buffer_nodes},
                      {"rms", report.buffer_rms},
                      {"largest", report.buffer_largest},
                      {"mean", report.buffer_mean}};
    return {{"buffer_difference", difference}};
}

/// A later entry of one name replaces an earlier one.
template <class Pairs>
Json object_of(const Pairs& pairs) {
    Json object = Json::object();
    for (const auto& pair : pairs) object[pair.first] = pair.second;
    return object;
}

void add_head(const Report& report, Json& json) {
    json["version"] = report.version;
    json["scene"] = report.scene;
    json["method"] = report.method;
    json["isa"] = report.isa;
    json["threads"] = report.threads;
    json["team"] = report.team;
    json["seed"] = report.seed;
    json["overrides"] = report.overrides;
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
    json["plan"] = plan_of(report);
    json["memory"] = {{"peak_bytes", report.peak_bytes}};
    json["time"] = time_of(report);

    json["interrupted"] = report.interrupted;
    json["photons"] = report.photons;
    json["generations"] = report.generations;
    json["paths"] = report.paths;
    json["samples_per_pixel"] = report.samples_per_pixel;
    json["ahead"] = ahead_of(report);
    json["ring"] = ring_of(report);
    json["frame_work"] = frame_work_of(report.frame_work);
    json["scatterings"] = report.scatterings;
    json["tentative"] = report.tentative;
    json["crossings"] = report.crossings;
    json["shadow_rays"] = report.shadow_rays;
    json["scatterings_per_second"] =
        rate_of(report.scatterings - report.earlier_scatterings, report.tracing_cpu_s);
    json["photons_per_second"] = rate_of(report.photons, report.tracing_cpu_s);
    json["paths_per_second"] = rate_of(report.paths - report.earlier_paths, report.tracing_cpu_s);
    json["mean_path_m"] = report.mean_path_m;
    json["samples"] = report.samples;
    json["leaves"] = report.leaves;
    json["collectors"] = report.collectors;

    json["clouds"] = clouds_of(report.clouds);
    json["energy"] = energy_of(report);
    json["error"] = error_of(report);
    json["verify"] = verify_of(report);
    json["light"] = light_of(report);
    json["warnings"] = report.warnings;
    json["counters"] = object_of(report.counters);
    json["executed"] = object_of(report.executed);
    json["digests"] = object_of(report.digests);
    return text_of(json);
}

std::string plan_json(const Report& report) {
    Json json;
    add_head(report, json);
    json["plan"] = plan_of(report);
    const ReportForetold& time = report.foretold;
    if (time.total_s > 0)
        json["foretold_time"] = {{"total_s", time.total_s},
                                 {"first_frame_s", time.first_frame_s},
                                 {"next_frame_s", time.next_frame_s}};
    return text_of(json);
}

Status write_report(const Report& report, const std::string& path) {
    const std::string text = report_json(report);
    return write_file(path, {text.data(), text.size()});
}

}  // namespace pileus
