// SPDX-License-Identifier: Apache-2.0
// Records of runs as JSON, so that an interrupted study goes on where it stopped.
// in: reports and records of untrusted text -> out: RunRecord; in: RunRecord -> out: a file.
// docs/study.md, "Runs"
#define JSON_NOEXCEPTION 1
#include <nlohmann/json.hpp>

#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "tools/study/study_runs.h"

namespace pileus {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 24;

bool read_json(const std::string& path, Json& json) {
    Buffer<char> bytes;
    if (!read_whole_file(path, kMaxBytes, bytes) || bytes.empty()) return false;
    json = Json::parse(bytes.data(), bytes.data() + bytes.size(), nullptr, false);
    return json.is_object();
}

/// A member of an object by one or two names; null where any is missing.
const Json* member(const Json& json, const char* first, const char* second = nullptr) {
    const auto outer = json.find(first);
    if (outer == json.end()) return nullptr;
    if (second == nullptr) return &*outer;
    if (!outer->is_object()) return nullptr;
    const auto inner = outer->find(second);
    return inner != outer->end() ? &*inner : nullptr;
}

double number_at(const Json& json, const char* first, const char* second = nullptr) {
    const Json* value = member(json, first, second);
    return value != nullptr && value->is_number() ? value->get<double>() : 0;
}

std::string text_at(const Json& json, const char* key) {
    const Json* value = member(json, key);
    return value != nullptr && value->is_string() ? value->get<std::string>() : "";
}

}  // namespace

bool read_report(const std::string& path, RunRecord& record) {
    Json json;
    if (!read_json(path, json)) return false;
    record.hash = text_at(json, "hash");
    record.isa = text_at(json, "isa");
    record.render_wall_s = number_at(json, "time", "total_s");
    record.render_cpu_s = number_at(json, "time", "cpu_s");
    const double peak = number_at(json, "memory", "peak_bytes");
    if (peak > 0) record.peak_bytes = peak;
    record.photons = number_at(json, "photons");
    record.scatterings = number_at(json, "scatterings");
    record.samples_per_pixel = number_at(json, "samples_per_pixel");
    return !record.hash.empty();
}

bool read_record(const StudyRun& run, RunRecord& record) {
    Json json;
    Image image;
    if (!read_json(run.record, json) || text_at(json, "digest") != run.digest) return false;
    record = RunRecord();
    record.hash = text_at(json, "hash");
    if (!read_image(run.image, image) || pixel_hash(image) != record.hash) return false;
    record.isa = text_at(json, "isa");
    record.wall_s = number_at(json, "wall_s");
    record.cpu_s = number_at(json, "cpu_s");
    record.render_wall_s = number_at(json, "render_wall_s");
    record.render_cpu_s = number_at(json, "render_cpu_s");
    record.peak_bytes = number_at(json, "peak_bytes");
    record.photons = number_at(json, "photons");
    record.scatterings = number_at(json, "scatterings");
    record.samples_per_pixel = number_at(json, "samples_per_pixel");
    record.done = record.earlier = true;
    return true;
}

Status write_record(const StudyRun& run, const RunRecord& record) {
    const Json json = {{"digest", run.digest},
                       {"arguments", run.words},
                       {"hash", record.hash},
                       {"isa", record.isa},
                       {"wall_s", record.wall_s},
                       {"cpu_s", record.cpu_s},
                       {"render_wall_s", record.render_wall_s},
                       {"render_cpu_s", record.render_cpu_s},
                       {"peak_bytes", record.peak_bytes},
                       {"photons", record.photons},
                       {"scatterings", record.scatterings},
                       {"samples_per_pixel", record.samples_per_pixel}};
    const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
    return write_file(run.record, {text.data(), text.size()});
}

}  // namespace pileus
