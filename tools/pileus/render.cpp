// SPDX-License-Identifier: Apache-2.0
// pileus render: a scene to pictures and a report, frame after frame.
// in: a scene and options -> out: files; on stdout a line for each with its pixel hash.
// docs/program.md
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "lab/views/view_list.h"
#include "platform/clock.h"
#include "platform/process.h"
#include "platform/threads.h"
#include "src/base/file.h"
#include "src/clouds/render_clouds.h"
#include "src/methods/registry.h"
#include "src/methods/support.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/picture_format.h"
#include "tools/pileus/block_files.h"
#include "tools/pileus/command.h"
#include "tools/pileus/hash_list.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/part_files.h"
#include "tools/pileus/progress.h"
#include "tools/pileus/rank_files.h"
#include "tools/pileus/rank_render.h"
#include "tools/pileus/ranks.h"
#include "tools/pileus/render_outputs.h"
#include "tools/pileus/scene_options.h"
#include "tools/pileus/tile_files.h"
#include "tools/pileus/tone_options.h"
#include "tools/pileus/version_text.h"

namespace pileus {

namespace {

struct RenderArguments {
    SceneArguments scene;
    std::vector<std::string> files;
    ToneArguments tone;
    std::optional<std::string> report, frames, show, state, state_every, verify;
    std::optional<std::string> expect_hash;
    PartArguments parts;
    BlockArguments blocks;
    bool quiet = false, strict = false, world_file = false;
};

Status read_state(const RenderArguments& arguments, RenderOptions& options) {
    constexpr double kMaxSeconds = 1e9;
    options.budget.state = arguments.state.value_or("");
    if (arguments.state && options.budget.state.empty())
        return Status::bad_input("--state: no name, \"\", allowed: the name of a file");
    if (!arguments.state_every) return Status::ok();
    if (!arguments.state)
        return Status::bad_input("--state-every: without --state, allowed: both or neither");
    return read_number("--state-every", *arguments.state_every, 1e-3, kMaxSeconds,
                       options.budget.state_every_s);
}

/// -o takes all words up to the next option; a scene among them is no picture.
void take_scene(RenderArguments& arguments) {
    if (!arguments.scene.scene.empty()) return;
    for (std::size_t i = 0; i < arguments.files.size(); ++i) {
        if (file_extension(arguments.files[i]) != ".toml") continue;
        arguments.scene.scene = arguments.files[i];
        arguments.files.erase(arguments.files.begin() + std::ptrdiff_t(i));
        return;
    }
}

/// What is to be seen, and how bright.
Status read_view(const RenderArguments& arguments, RenderOptions& options, Outputs& outputs) {
    constexpr std::int64_t kMaxVerified = 1000000;  // pixels, a thousand paths each
    Status faults;
    if (arguments.show) {
        MethodRow view;
        add_fault(find_view("", *arguments.show, view), faults);
        if (!view.shows_light) add_fault(refuse_tone(arguments.tone), faults);
        options.show = *arguments.show;
        options.find_view = find_view;
    }
    add_fault(read_tone(arguments.tone, outputs.tone), faults);
    outputs.says_exposure = outputs.tone.automatic && !arguments.quiet;
    if (arguments.verify)
        add_fault(read_integer("--verify", *arguments.verify, 1, kMaxVerified, options.verify),
                  faults);
    if (arguments.verify && arguments.show)
        add_fault(Status::bad_input("--verify: a view is no picture of light, allowed: without "
                                    "--show"),
                  faults);
    return faults;
}

/// Which frames are rendered, which of them are written, and what they should be.
Status choose_frames(const RenderArguments& arguments, const Scene& scene, RenderOptions& options,
                     Outputs& outputs) {
    const int frames = scene.animation.present ? scene.animation.frames : 1;
    options.last_frame = frames - 1;
    const std::optional<PictureScene>& picture = arguments.scene.picture;
    if (arguments.frames)
        PILEUS_TRY(read_frames(*arguments.frames, frames, options.first_frame, options.last_frame));
    else if (picture)
        PILEUS_TRY(picture_frames(*picture, scene, options.first_frame, options.last_frame));
    // Frames before a picture's own only lead up to it.
    outputs.first_frame = picture && !arguments.frames ? options.last_frame : options.first_frame;
    outputs.numbered = frames > 1;
    if (picture) PILEUS_TRY(check_scene_files(*picture, scene));
    if (!arguments.expect_hash) return Status::ok();
    return check_frame_hashes(outputs.hashes, options.last_frame - outputs.first_frame + 1);
}

/// Names on the command line start at the working directory, those in a scene at its folder.
Status choose_files(const RenderArguments& arguments, const Scene& scene, RenderOptions& options,
                    Outputs& outputs) {
    outputs.files = arguments.files;
    // A picture stands for the scene of another time: nothing of then is written over.
    const bool remade = arguments.scene.picture.has_value();
    if (outputs.files.empty() && !remade)
        for (const std::string& file : scene.output.files)
            outputs.files.push_back(scene_path(scene.directory, file));
    // -o stands for all that the scene would write: its report is of another picture.
    const bool own_report = arguments.files.empty() && !remade && !scene.output.report.empty();
    outputs.report_printed = arguments.report && *arguments.report == "-";
    if (arguments.report && !outputs.report_printed) outputs.report = *arguments.report;
    if (!arguments.report && own_report)
        outputs.report = scene_path(scene.directory, scene.output.report);
    options.digests = !outputs.report.empty() || outputs.report_printed;
    outputs.nothing = outputs.files.empty() && !options.digests;
    if (outputs.nothing && remade && outputs.hashes.empty())
        return Status::bad_input(scene.file +
                                 ": no output, allowed: -o FILE or --report FILE, or no option "
                                 "that changes the picture, to compare its hash alone");
    if (outputs.nothing && !remade)
        return Status::bad_input(scene.file +
                                 ": output.files: no output, allowed: -o FILE, --report FILE or "
                                 "output.files in the scene");
    PILEUS_TRY(check_tone_files(arguments.tone, outputs.files));
    if (arguments.world_file) PILEUS_TRY(add_world_files(scene, outputs));
    return check_outputs(outputs, scene, options);
}

/// A picture that is made again as it was has the hash that it had.
void expect_picture(RenderArguments& arguments, Outputs& outputs) {
    if (!arguments.scene.picture) return;
    const PictureScene& picture = *arguments.scene.picture;
    // Between two releases a picture's bits may change, too.
    const std::string of_picture = version_text(picture.version, picture.commit);
    if (of_picture != version_text())
        outputs.remark = "; it is of version " + of_picture + ", this is " + version_text();
    if (picture.edited)
        outputs.remark += "; its pixels are not those that it names (pileus.pixelHash)";
    const bool same = !is_changed(arguments.scene) && !arguments.frames && !arguments.show;
    if (!arguments.show && !picture.show.empty()) arguments.show = picture.show;
    if (same && !arguments.expect_hash && !arguments.blocks.file) outputs.hashes = {picture.hash};
}

/// Of many clouds each kind has a method, and its keys, of its own.
Status check_cloud_options(const RenderArguments& arguments, const Scene& scene) {
    if (!scene.clouds.present()) return Status::ok();
    const char* const keys = support(Feature::kBudgetPhotons, MethodColumn::kCloudSkies).allowed;
    const char* const out = support(Feature::kState, MethodColumn::kCloudSkies).allowed;
    const struct {
        const char* option;
        bool given;
        const char* allowed;
    } rows[] = {{"--budget", !arguments.scene.budgets.empty(), keys},
                {"--quality", bool(arguments.scene.quality), keys},
                {"--show", bool(arguments.show), out},
                {"--verify", bool(arguments.verify),
                 "left out; clouds.detail.off=true is what to compare with"},
                {"--state", bool(arguments.state), out},
                {"--blocks", bool(arguments.blocks.file), out}};
    Status faults;
    for (const auto& row : rows)
        if (row.given)
            add_fault(Status::bad_input(std::string(row.option) +
                                        ": not for a scene with [clouds], allowed: " + row.allowed),
                      faults);
    return faults;
}

/// Options win over the scene; faults of all options come before those of the files.
Status read_arguments(RenderArguments& arguments, Scene& scene, RenderOptions& options,
                      Outputs& outputs) {
    Status faults = read_view(arguments, options, outputs);
    add_fault(read_state(arguments, options), faults);
    add_fault(read_tiles(arguments.files, arguments.parts), faults);
    if (arguments.expect_hash)
        add_fault(read_frame_hashes(*arguments.expect_hash, outputs.hashes), faults);
    add_fault(read_block_arguments(arguments.blocks, outputs.blocks), faults);
    add_fault(read_scene_options(arguments.scene, scene, options), faults);
    PILEUS_TRY(faults);
    PILEUS_TRY(check_cloud_options(arguments, scene));
    PILEUS_TRY(choose_frames(arguments, scene, options, outputs));
    PILEUS_TRY(choose_part(arguments.parts, divided_run(scene), options));
    if (arguments.parts.tiles && (arguments.world_file || arguments.strict))
        return Status::bad_input("--tiles: with --world-file or --strict, allowed: without these");
    if (is_part(options) || !outputs.blocks.file.empty())
        PILEUS_TRY(check_tone_files(arguments.tone, arguments.files));
    if (is_part(options)) return check_part_file(arguments.files, options, scene);
    if (outputs.blocks.file.empty()) return choose_files(arguments, scene, options, outputs);
    // Blocks are all that such a run writes.
    if (!arguments.files.empty() || arguments.report)
        return Status::bad_input("--blocks: together with -o or --report, allowed: without");
    if (arguments.expect_hash)
        return Status::bad_input("--blocks: together with --expect-hash, allowed: without");
    return check_names({outputs.blocks.file}, false, options.first_frame, options.last_frame,
                       scene);
}

/// What there is of a picture that the user did not let finish.
std::string interrupted_line(int frame, bool numbered, const Report& report) {
    const std::string where = numbered ? fmt::format("frame {}: ", frame) : std::string();
    if (report.paths.samples_per_pixel > 0)
        return fmt::format("{}interrupted: {} samples per pixel", where,
                           report.paths.samples_per_pixel);
    return fmt::format("{}interrupted: {} generations, {} photons", where,
                       report.photons.generations, report.photons.traced);
}

/// Says each warning once, whatever frame has it; returns whether there are any.
bool tell_warnings(const Report& report, std::set<std::string>& told) {
    for (const std::string& warning : report.warnings)
        if (told.insert(warning).second) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    return !report.warnings.empty();
}

/// What a run has said of its pictures, and what is wrong with them.
struct Findings {
    std::set<std::string> told;  ///< warnings
    std::string ended;           ///< how far an interrupted picture came
    Status hashes;               ///< a line for each picture that should have another
    bool doubtful = false;
};

/// Writes one frame; one with another hash than it should have, too, so that it can be looked at.
Status take_frame(const Scene& scene, const Outputs& outputs, int frame, Image& image,
                  Report& report, Findings& found) {
    if (image.pixel_hash.empty()) image.pixel_hash = pixel_hash(image);
    if (report.hash.empty()) report.hash = image.pixel_hash;
    if (report.interrupted) found.ended = interrupted_line(frame, outputs.numbered, report);
    std::vector<std::string> hashes;
    PILEUS_TRY(write_frame(outputs, scene, frame, image, report, hashes));
    found.doubtful = tell_warnings(report, found.told) || found.doubtful;
    add_fault(check_frame_hash(scene, outputs, frame, hashes), found.hashes);
    return Status::ok();
}

/// All frames, one after the other.
Status render_all(const Scene& scene, const RenderOptions& options, const Outputs& outputs,
                  Progress& progress, Findings& found) {
    const int count = options.last_frame - options.first_frame + 1;
    const double tracing = wall_seconds();
    progress.frames(0, count, 0);
    int next = std::max(outputs.first_frame, options.first_frame);
    const bool by_ranks = ranks().count > 1 && !outputs.numbered;
    const auto draw = by_ranks ? render_by_ranks : scene.clouds.present() ? render_clouds : render;
    Status status = draw(scene, options, [&](int frame, Image& image, Report& report) -> Status {
        progress.clear();
        if (frame >= outputs.first_frame)
            PILEUS_TRY(take_frame(scene, outputs, frame, image, report, found));
        next = frame + 1;
        progress.frames(frame - options.first_frame + 1, count, wall_seconds() - tracing);
        return Status::ok();
    });
    progress.clear();
    PILEUS_TRY(status);
    // Frames that an interrupted run has not come to are not as they should be, either.
    for (; next <= options.last_frame && !(by_ranks && !ranks().is_first()); ++next)
        add_fault(check_frame_hash(scene, outputs, next, {}), found.hashes);
    return Status::ok();
}

/// The lines and the exit status of a run that went through.
Status conclude(const Findings& found, bool strict) {
    Status end = found.hashes;
    if (found.doubtful && strict) end.code = Code::kCheckFailed;
    if (!found.ended.empty())
        end.message = found.ended + (end.message.empty() ? "" : "\n") + end.message;
    return end;
}

Status run_render(RenderArguments& arguments) {
    const double start = wall_seconds();
    Scene scene;
    RenderOptions options;
    Outputs outputs;
    take_scene(arguments);
    PILEUS_TRY(agree(take_picture(arguments.scene)));
    expect_picture(arguments, outputs);
    StagedFiles staged;
    PILEUS_TRY(staged.stage(arguments.parts.stage, arguments.scene));
    Status read = read_arguments(arguments, scene, options, outputs);
    if (read && ranks().count > 1 && (arguments.parts.given() || arguments.blocks.file))
        read = Status::bad_input(
            "--part, --tiles, --blocks: among ranks of MPI, allowed: one process");
    if (read && arguments.parts.stage && (outputs.numbered || arguments.state))
        read = Status::bad_input("--stage: of a film or with --state, allowed: one picture");
    if (read) read = share_ranks(bool(arguments.scene.threads), divided_run(scene), options);
    PILEUS_TRY(agree(read));

    const bool first = ranks().is_first();
    Progress progress(first && !arguments.quiet && stderr_is_terminal());
    options.progress = [&](const char* stage, double share) { progress.tell(stage, share); };
    catch_interrupts(first ? "interrupted before there was anything to keep; no file written" : "",
                     int(Code::kCheckFailed));
    options.interrupted = interrupt_asked;
    options.holding = hold_interrupts;
    if (arguments.parts.tile_side > 0) {
        Status status = render_tiles(scene, options, outputs, arguments.parts.tile_side);
        progress.clear();
        return status;
    }
    if (is_part(options)) {
        Status status = write_part(scene, options, arguments.files[0]);
        progress.clear();
        return status;
    }
    if (!outputs.blocks.file.empty()) {
        Status status = render_blocks(scene, options, outputs.blocks);
        progress.clear();
        return status;
    }
    Findings found;
    PILEUS_TRY(agree(render_all(scene, options, outputs, progress, found)));
    hold_interrupts(true);
    if (first && !arguments.quiet && !outputs.report_printed)
        PILEUS_TRY(print(fmt::format("{:16} {:.3f} s\n", "total", wall_seconds() - start)));
    return conclude(found, arguments.strict);
}

}  // namespace

void add_render(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand("render", "Render a scene to pictures and a report");
    const auto arguments = std::make_shared<RenderArguments>();
    add_scene_options(*command, arguments->scene,
                      "pileus render cloud.toml -o cloud.exr cloud.png --report cloud.json "
                      "--set sun.elevation_deg=10");
    add_picture_options(*command, arguments->scene);
    command
        ->add_option("-o,--output", arguments->files,
                     picture_extensions(is_written) +
                         ", instead of the scene's output.files and output.report")
        ->type_name("FILE");
    command
        ->add_option("--report", arguments->report,
                     "JSON report to write; - for the standard output")
        ->type_name("FILE");
    command
        ->add_option("--frames", arguments->frames, "Frames of an animation, from 0; left out: all")
        ->type_name("A-B");
    add_tone_options(*command, arguments->tone,
                     "Brightness of .png and .ppm in stops, or auto; left out: 0");
    command
        ->add_option("--show", arguments->show,
                     "A step of the method instead of its picture: " + view_names())
        ->type_name("VIEW");
    command
        ->add_option("--verify", arguments->verify,
                     "Trace so many pixels of each finished picture by paths, and say how far off "
                     "they are")
        ->type_name("N");
    command
        ->add_option("--state", arguments->state,
                     "Keep the path tracer's progress in this file, and go on from it")
        ->type_name("FILE");
    command
        ->add_option("--state-every", arguments->state_every,
                     "Seconds between two writings of it; left out: 60")
        ->type_name("S");
    add_part_options(*command, arguments->parts);
    command
        ->add_option("--blocks", arguments->blocks.file,
                     "Render under several seeds and write sums and squares by blocks of pixels "
                     "instead of pictures, for compare --welch")
        ->type_name("FILE");
    command
        ->add_option("--block-passes", arguments->blocks.passes,
                     "Seeds, from the scene's own on; left out: 16")
        ->type_name("N");
    command->add_option("--block-side", arguments->blocks.side, "Pixels; left out: 8")
        ->type_name("N");
    command
        ->add_option("--expect-hash", arguments->expect_hash,
                     "Exit status 1 where the picture has another pixel hash; it is written all "
                     "the same. Of several frames a hash each, parted by commas")
        ->type_name("HEX");
    command->add_flag("--strict", arguments->strict,
                      "Exit status 1 where a picture has warnings; it is written all the same");
    command->add_flag("--world-file", arguments->world_file,
                      "Write the place of a map beside each picture: .pgw of .png, .wld of others");
    command->add_flag("-q,--quiet", arguments->quiet, "No progress and no total");
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_render(*arguments); }; });
}

}  // namespace pileus
