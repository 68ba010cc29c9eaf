// SPDX-License-Identifier: Apache-2.0
// pileus merge: parts of a picture, from any number of machines, to the picture of one run.
// in: files of render --part -> out: pictures and a report, as render writes them.
// docs/farm.md
#include <fmt/format.h>

#include <memory>
#include <set>

#include "platform/clock.h"
#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "src/scene/rows/picture_format.h"
#include "src/session/parts/parts.h"
#include "tools/pileus/command.h"
#include "tools/pileus/hash_list.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/part_files.h"
#include "tools/pileus/progress.h"
#include "tools/pileus/render_outputs.h"
#include "tools/pileus/scene_options.h"
#include "tools/pileus/tone_options.h"
#include "tools/study/output_check.h"

namespace pileus {
namespace {

struct MergeArguments {
    std::vector<std::string> parts, files;
    ToneArguments tone;
    std::optional<std::string> report, folder, threads, expect_hash;
    bool mean = false, quiet = false;
};

/// Each says where its scene lies from there; they need not lie in one folder.
std::string take_folder(Part& part) {
    std::string folder;
    auto& origin = part.rows.origin;
    for (std::size_t i = origin.size(); i-- > 0;)
        if (origin[i].first == "folder") {
            folder = origin[i].second;
            origin.erase(origin.begin() + std::ptrdiff_t(i));
        }
    return folder;
}

/// The scene that the parts tell, with its options; `folder` as the first file has it.
Status read_told(const MergeArguments& arguments, const Part& part, const std::string& folder,
                 Scene& scene, RenderOptions& options) {
    SceneArguments told;
    told.scene = arguments.parts[0];
    told.folder = arguments.folder;
    told.threads = arguments.threads;
    Image run;
    run.scene_text = part.rows.scene_text;
    run.origin = part.rows.origin;
    if (!folder.empty()) run.origin.emplace_back("folder", folder);
    PictureScene picture;
    PILEUS_TRY(take_run(told.scene, run, arguments.folder, picture));
    if (picture.version != kVersion)
        return Status::bad_input(part.name + ": part: of version " +
                                 printable_line(picture.version) + ", allowed: " + kVersion);
    told.picture = std::move(picture);
    PILEUS_TRY(read_scene_options(told, scene, options));
    options.first_frame = options.last_frame = part.frame;
    return check_scene_files(*told.picture, scene);
}

Status choose_outputs(const MergeArguments& arguments, const Scene& scene, RenderOptions& options,
                      Outputs& outputs) {
    Status faults;
    add_fault(read_tone(arguments.tone, outputs.tone), faults);
    outputs.says_exposure = outputs.tone.automatic && !arguments.quiet;
    add_fault(check_tone_files(arguments.tone, arguments.files), faults);
    if (arguments.expect_hash)
        add_fault(read_frame_hashes(*arguments.expect_hash, outputs.hashes), faults);
    outputs.files = arguments.files;
    outputs.report_printed = arguments.report && *arguments.report == "-";
    if (arguments.report && !outputs.report_printed) outputs.report = *arguments.report;
    options.digests = !outputs.report.empty() || outputs.report_printed;
    outputs.first_frame = options.first_frame;
    if (outputs.files.empty() && !options.digests)
        add_fault(Status::bad_input("merge: no output, allowed: -o FILE or --report FILE"), faults);
    OutputCheck check;
    for (const std::string& part : arguments.parts) check.reads(part, "a part");
    for (const std::string& file : outputs.files) add_fault(check.writes(file), faults);
    PILEUS_TRY(faults);
    return check_outputs(outputs, scene, options);
}

Status run_merge(const MergeArguments& arguments) {
    std::vector<Part> parts;
    PILEUS_TRY(read_part_files(arguments.parts, parts));
    std::string folder;
    for (std::size_t p = parts.size(); p-- > 0;) folder = take_folder(parts[p]);
    PILEUS_TRY(check_parts(arguments.mean, parts));
    Scene scene;
    RenderOptions options;
    Outputs outputs;
    PILEUS_TRY(read_told(arguments, parts[0], folder, scene, options));
    PILEUS_TRY(choose_outputs(arguments, scene, options, outputs));
    Progress progress(!arguments.quiet && stderr_is_terminal());
    options.progress = [&progress](const char* stage, double share) {
        progress.tell(stage, share);
    };
    Status hashes;
    const FrameSink write = [&](int frame, Image& image, Report& report) {
        progress.clear();
        std::vector<std::string> written;
        PILEUS_TRY(write_frame(outputs, scene, frame, image, report, written));
        for (const std::string& warning : report.warnings)
            std::fprintf(stderr, "warning: %s\n", warning.c_str());
        add_fault(check_frame_hash(scene, outputs, frame, written), hashes);
        return Status::ok();
    };
    PILEUS_TRY(merge_parts(scene, options, parts, write));
    return hashes;
}

}  // namespace

void add_merge(CLI::App& app, Chosen& chosen) {
    CLI::App* command =
        app.add_subcommand("merge", "Put the parts of a picture together to that of one run");
    const auto arguments = std::make_shared<MergeArguments>();
    command->add_option("parts", arguments->parts, "All parts, in any order")
        ->type_name("FILE.part");
    command
        ->add_option("-o,--output", arguments->files,
                     picture_extensions(is_written) + ", the picture")
        ->type_name("FILE");
    command
        ->add_option("--report", arguments->report,
                     "JSON report to write; - for the standard output")
        ->type_name("FILE");
    command
        ->add_option("--folder", arguments->folder,
                     "Where names in the scene start; left out: as the first part says, or its own "
                     "folder")
        ->type_name("DIR");
    command->add_flag("--mean", arguments->mean,
                      "Take parts of several seeds: the mean of their pictures, with its error");
    add_tone_options(*command, arguments->tone,
                     "Brightness of .png and .ppm in stops, or auto; left out: 0");
    command
        ->add_option("--expect-hash", arguments->expect_hash,
                     "Exit status 1 where the picture has another pixel hash")
        ->type_name("HEX");
    command->add_option("--threads", arguments->threads, "Threads; left out: all there are")
        ->type_name("N");
    command->add_flag("-q,--quiet", arguments->quiet, "No progress");
    command->footer(help_example("pileus merge sky.*.part -o sky.exr"));
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_merge(*arguments); }; });
}

}  // namespace pileus
