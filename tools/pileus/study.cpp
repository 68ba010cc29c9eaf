// SPDX-License-Identifier: Apache-2.0
// pileus study: error against run time, over scenes, methods, settings, budgets and seeds.
// in: a study file -> out: a folder of runs, tables, plots and one page; progress on stderr.
// docs/study.md
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>

#include "platform/clock.h"
#include "platform/fs_path.h"
#include "platform/process.h"
#include "platform/threads.h"
#include "src/base/file.h"
#include "src/base/limits.h"
#include "src/io/images/image_file.h"
#include "src/run/find_kernels.h"
#include "src/session/render.h"
#include "tools/pileus/command.h"
#include "tools/pileus/info.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/part_files.h"
#include "tools/pileus/ranks.h"
#include "tools/study/study_execute.h"
#include "tools/study/study_report.h"

namespace pileus {

namespace {

struct StudyArguments {
    std::string file;
    std::optional<std::string> folder, references, threads, isa, program, part;
    std::vector<std::string> scenes, methods;
    bool list = false, quiet = false;
};

Status read_options(const StudyArguments& arguments, StudyOptions& options) {
    const std::string stem = path_text(path_of(arguments.file).stem());
    options.folder = arguments.folder.value_or(stem + ".study");
    options.references = arguments.references.value_or("");
    options.program = arguments.program.value_or(own_program(nullptr));
    options.version = kVersion;
    options.threads = std::max(hardware_threads() / ranks().beside, 1);
    options.hidden.assign(std::begin(kLauncherVariables), std::end(kLauncherVariables));
    options.isa = arguments.isa.value_or("");
    options.only_scenes = arguments.scenes;
    options.only_methods = arguments.methods;
    Status faults;
    std::int64_t threads = 0;
    if (arguments.threads)
        add_fault(read_integer("--threads", *arguments.threads, 1, kMaxThreads, threads), faults);
    if (threads > 0) options.threads = int(threads);
    const KernelTable* kernels = nullptr;
    add_fault(find_kernels(options.isa, kernels), faults);
    for (const std::string& folder : {options.folder, options.references})
        if (!folder.empty()) add_fault(check_file_name(folder), faults);
    PILEUS_TRY(faults);
    PILEUS_TRY(can_write_image("study.exr"));
    return can_write_file(options.folder + "/study.json");
}

void tell(void*, const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

/// One line for each run, for a look before the hours.
Status print_runs(const std::vector<StudyRun>& runs) {
    std::string text;
    for (const StudyRun& run : runs) {
        text += run.digest + " pileus";
        for (const std::string& word : run.words) text += ' ' + word;
        text += '\n';
    }
    return print(text);
}

/// What a user wants to see at the end without opening a file.
std::string result_lines(const Study& study, const StudyOptions& options,
                         const StudyResult& result) {
    std::string text;
    for (const SceneResult& scene : result.scenes) {
        text += fmt::format("{}\n", study.scenes[std::size_t(scene.scene)].title);
        if (!scene.fault.empty()) text += "  no result: " + scene.fault + "\n";
        if (scene.fault.empty()) text += "  reference: " + reference_text(scene) + "\n";
        for (const CurveResult& curve : scene.curves)
            text += fmt::format("  {:<34} to relMSE {}: {}; floor: {}\n",
                                study.curves[std::size_t(curve.curve)].title,
                                number_short(study.targets[0]),
                                target_text(curve.to_target[0], curve.fit), floor_text(curve.fit));
    }
    for (const std::string& fault : result.faults) text += fault + "\n";
    return text + options.folder + "/index.html\n";
}

/// Which of the runs are made here.
Status choose_share(const StudyArguments& arguments, WorkPart& share) {
    const Ranks& r = ranks();
    if (r.count > 1) share = {std::uint32_t(r.rank), std::uint32_t(r.count), true};
    if (!arguments.part) return Status::ok();
    if (r.count > 1) return Status::bad_input("--part: among ranks of MPI, allowed: one process");
    RenderOptions options;
    PILEUS_TRY(choose_part(*arguments.part, 0, options));
    share = options.part;
    return Status::ok();
}

std::vector<StudyRun> runs_of(const WorkPart& share, const std::vector<StudyRun>& all) {
    std::vector<StudyRun> own;
    for (std::size_t i = share.index; i < all.size(); i += share.count) own.push_back(all[i]);
    return own;
}

Status make_runs(const Study& study, const StudyOptions& options, const std::vector<StudyRun>& runs,
                 std::vector<RunRecord>& records) {
    bool stopped = false;
    {
        const InterruptHold hold;
        PILEUS_TRY(execute_runs(study, options, runs, hold, records, stopped));
    }
    // The signal that stopped us has ended the program unless its sender ignores it.
    if (stopped) return {Code::kCheckFailed, "pileus study: interrupted"};
    return Status::ok();
}

Status failed_runs(std::size_t failed) {
    if (failed == 0) return Status::ok();
    return {Code::kCheckFailed, fmt::format("pileus study: {} runs failed", failed)};
}

/// Makes a share of the runs, of which the folder then has the records.
Status make_share(const Study& study, const StudyOptions& options,
                  const std::vector<StudyRun>& runs) {
    std::vector<RunRecord> records;
    PILEUS_TRY(make_runs(study, options, runs, records));
    std::size_t failed = 0;
    for (const RunRecord& record : records) failed += record.done ? 0 : 1;
    // Rank 0 tries what failed again, and tells of it.
    if (ranks().count > 1) return Status::ok();
    PILEUS_TRY(print(fmt::format("{} of {} runs of this part are in {}\n", runs.size() - failed,
                                 runs.size(), options.folder)));
    return failed_runs(failed);
}

Status run_study(const StudyArguments& arguments) {
    Study study;
    StudyOptions options;
    WorkPart share;
    std::vector<StudyRun> runs;
    std::vector<RunRecord> records;
    const auto read = [&] {
        PILEUS_TRY(read_options(arguments, options));
        PILEUS_TRY(choose_share(arguments, share));
        PILEUS_TRY(read_study_file(arguments.file, study));
        return list_runs(study, options, runs);
    };
    PILEUS_TRY(agree(read()));
    const bool first = ranks().is_first();
    if (arguments.list && ranks().count > 1) share = {};
    if (arguments.list) return first ? print_runs(runs_of(share, runs)) : Status::ok();
    if (!arguments.quiet) options.progress = tell;

    std::vector<bool> earlier;
    if (ranks().count > 1) {
        // Before any rank begins.
        RunRecord record;
        for (const StudyRun& run : runs) earlier.push_back(first && read_record(run, record));
        PILEUS_TRY(agree(Status::ok()));
    }
    if (share.given) PILEUS_TRY(agree(make_share(study, options, runs_of(share, runs))));
    if (arguments.part || !first) return Status::ok();
    PILEUS_TRY(make_runs(study, options, runs, records));
    for (std::size_t i = 0; i < earlier.size(); ++i) records[i].earlier = earlier[i];
    StudyResult result;
    result.machine = {kVersion, compiler_text(),    processor_name(),
                      "",       hardware_threads(), options.threads};
    for (const RunRecord& record : records)
        if (record.done) result.machine.isa = record.isa;
    PILEUS_TRY(analyse_study(study, runs, records, result));
    PILEUS_TRY(write_study(study, options, result));
    PILEUS_TRY(print(result_lines(study, options, result)));
    return failed_runs(std::size_t(result.failed));
}

}  // namespace

void add_study(CLI::App& app, Chosen& chosen) {
    CLI::App* command =
        app.add_subcommand("study", "Measure error against run time and write a page about it");
    const auto arguments = std::make_shared<StudyArguments>();
    command->add_option("study", arguments->file, "The study file")
        ->required()
        ->type_name("STUDY.toml");
    command
        ->add_option("-o,--output", arguments->folder,
                     "Folder for everything; left out: the study's name with .study behind")
        ->type_name("DIR");
    command
        ->add_option("--references", arguments->references,
                     "Folder of references, to be shared by studies; left out: within the output")
        ->type_name("DIR");
    command->add_option("--threads", arguments->threads, "Threads of each run; left out: all")
        ->type_name("N");
    command
        ->add_option("--program", arguments->program,
                     "The pileus to measure; left out: this one. Another of the same version, for "
                     "what it costs now and what it cost before")
        ->type_name("FILE");
    command
        ->add_option(
            "--part", arguments->part,
            "Makes this share of the runs and no page: the same call without it makes that")
        ->type_name("I/N");
    command->add_option("--isa", arguments->isa, "Instruction set; left out: the widest")
        ->type_name("NAME");
    command->add_option("--scene", arguments->scenes, "Only this scene; may be repeated")
        ->allow_extra_args(false)
        ->type_name("NAME");
    command->add_option("--method", arguments->methods, "Only this method; may be repeated")
        ->allow_extra_args(false)
        ->type_name("NAME");
    command->add_flag("--list", arguments->list, "Print the runs and make none");
    command->add_flag("-q,--quiet", arguments->quiet, "No progress");
    command->footer(help_example("pileus study study.toml -o out/study --threads 4"));
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_study(*arguments); }; });
}

}  // namespace pileus
