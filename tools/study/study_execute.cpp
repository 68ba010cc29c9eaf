// SPDX-License-Identifier: Apache-2.0
// Runs the program once for each picture and keeps what it cost.
// in: runs -> out: records; a line of progress for each.
// docs/study.md, "Runs"
#include "tools/study/study_execute.h"

#include <fmt/format.h>

#include <cmath>
#include <system_error>

#include "platform/file_calls.h"

namespace pileus {

namespace {

std::string time_text(double seconds) {
    if (seconds < 100) return fmt::format("{:.1f} s", seconds);
    if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
    return fmt::format("{:.1f} h", seconds / 3600);
}

std::string run_text(const Study& study, const StudyRun& run) {
    const std::string& scene = study.scenes[std::size_t(run.scene)].name;
    if (run.is_reference()) return fmt::format("{} reference half {}", scene, run.repeat + 1);
    const StudyCurve& curve = study.curves[std::size_t(run.curve)];
    return fmt::format("{} {} {} seed {}", scene, curve.name,
                       curve.budgets[std::size_t(run.budget)], run.seed);
}

/// The first line of what a failed run said.
std::string fault_text(const ProcessResult& result) {
    if (result.system_error != 0)
        return "cannot be started: " + std::generic_category().message(result.system_error);
    std::string line = printable_line(result.errors.substr(0, result.errors.find('\n')));
    return fmt::format("exit status {}{}{}", result.exit_status, line.empty() ? "" : ": ", line);
}

Status run_once(const StudyOptions& options, const StudyRun& run, const InterruptHold& hold,
                RunRecord& record, bool& stopped) {
    const std::string report = run.record + ".report";
    std::vector<std::string> words{options.program};
    words.insert(words.end(), run.words.begin(), run.words.end());
    for (const std::string& word : {std::string("-o"), run.image, std::string("--report"), report})
        words.push_back(word);
    const ProcessResult result = run_process(words, hold, options.hidden);
    // A picture of a run that was cut short is not the one that was asked for.
    if (result.interrupted || hold.pending()) {
        stopped = true;
        remove_file(run.image.c_str());
        remove_file(report.c_str());
        return Status::ok();
    }
    record.wall_s = result.wall_s;
    record.cpu_s = result.cpu_s;
    record.peak_bytes = double(result.peak_bytes);
    const bool read = result.exit_status == 0 && read_report(report, record);
    remove_file(report.c_str());
    if (!read) {
        record.fault = fault_text(result);
        return Status::ok();
    }
    record.done = true;
    return write_record(run, record);
}

/// How far apart two runs are as measures of each other's time: 0 is the same.
double distance(const StudyRun& a, const StudyRun& b) {
    double far = 0;
    if (a.is_reference() != b.is_reference()) far += 1e6;
    if (a.curve != b.curve) far += 1e5;
    if (a.scene != b.scene) far += 2;
    if (a.amount > 0 && b.amount > 0) far += std::fabs(std::log(a.amount / b.amount));
    return far;
}

}  // namespace

double remaining_seconds(const std::vector<StudyRun>& runs, const std::vector<RunRecord>& records) {
    double whole = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (records[i].done || !records[i].fault.empty()) continue;
        std::size_t nearest = runs.size();
        double least = 0;
        for (std::size_t j = 0; j < runs.size(); ++j) {
            if (!records[j].done) continue;
            const double far = distance(runs[i], runs[j]);
            if (nearest < runs.size() && far >= least) continue;
            nearest = j;
            least = far;
        }
        if (nearest == runs.size()) continue;
        const StudyRun& known = runs[nearest];
        const bool scales = known.curve == runs[i].curve && known.amount > 0;
        whole += records[nearest].wall_s * (scales ? runs[i].amount / known.amount : 1.0);
    }
    return whole;
}

Status execute_runs(const Study& study, const StudyOptions& options,
                    const std::vector<StudyRun>& runs, const InterruptHold& hold,
                    std::vector<RunRecord>& records, bool& stopped) {
    stopped = false;
    records.assign(runs.size(), RunRecord());
    std::size_t missing = 0, made = 0;
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (!read_record(runs[i], records[i])) ++missing;
    const auto tell = [&](const std::string& line) {
        if (options.progress != nullptr) options.progress(options.context, line);
    };
    if (missing < runs.size())
        tell(fmt::format("{} of {} runs are there already", runs.size() - missing, runs.size()));

    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (records[i].done) continue;
        PILEUS_TRY(run_once(options, runs[i], hold, records[i], stopped));
        if (stopped) {
            tell(fmt::format("interrupted: {} of {} runs missing, the same command goes on",
                             missing - made, runs.size()));
            return Status::ok();
        }
        ++made;
        const std::string what = records[i].done ? fmt::format("{:.2f} s CPU", records[i].cpu_s)
                                                 : "failed, " + records[i].fault;
        tell(fmt::format("[{}/{}] {}: {}; {} left", made, missing, run_text(study, runs[i]), what,
                         time_text(remaining_seconds(runs, records))));
    }
    return Status::ok();
}

}  // namespace pileus
