// SPDX-License-Identifier: Apache-2.0
// pileus render: a scene to pictures and a report, frame after frame.
// in: a scene and options -> out: files; on stdout a line for each with its pixel hash.
// docs/program.md
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "platform/clock.h"
#include "platform/interrupt.h"
#include "src/base/file.h"
#include "src/base/output_check.h"
#include "src/io/text/report_json.h"
#include "src/io/text/scene_files.h"
#include "src/methods/registry.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/picture_format.h"
#include "src/world/camera/places.h"
#include "tools/pileus/block_files.h"
#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/output_set.h"
#include "tools/pileus/progress.h"
#include "tools/pileus/scene_options.h"

namespace pileus {

namespace {

struct RenderArguments {
    SceneArguments scene;
    std::vector<std::string> files;
    std::optional<std::string> report, frames, exposure, show, state, state_every, verify;
    BlockArguments blocks;
    bool quiet = false, strict = false, world_file = false;
};

/// Everything a frame needs to be written.
struct Outputs {
    std::vector<std::string> files;
    std::vector<std::string> world_files;  ///< beside them; none, or one for each
    std::string report;
    bool report_printed = false;  ///< --report -: on the standard output, and nothing else there
    ToneSettings tone;
    BlockSettings blocks;
    bool numbered = false;  ///< the scene has several frames, so names carry the frame's number
};

/// Pixels of --verify: a thousand paths each.
constexpr std::int64_t kMostVerified = 1000000;

std::string frame_path(const std::string& path, int frame, bool numbered) {
    return numbered ? numbered_path(path, frame) : path;
}

Status read_state(const RenderArguments& arguments, RenderOptions& options) {
    constexpr double kMostSeconds = 1e9;
    options.state = arguments.state.value_or("");
    if (arguments.state && options.state.empty())
        return Status::bad_input("--state: no name, \"\", allowed: the name of a file");
    if (!arguments.state_every) return Status::ok();
    if (!arguments.state)
        return Status::bad_input("--state-every: without --state, allowed: both or neither");
    return read_number("--state-every", *arguments.state_every, 1e-3, kMostSeconds,
                       options.state_every_s);
}

/// Refuses to write over what is read, or two outputs into one file, in any of the frames.
Status check_names(const std::vector<std::string>& all, bool numbered, const Scene& scene,
                   const RenderOptions& options) {
    OutputCheck check;
    Status faults;
    check.reads(scene.file, "the scene itself");
    for (const std::string& file : scene_files(scene))
        check.reads(file, "a file that the scene reads");
    for (int frame = options.first_frame; frame <= options.last_frame && faults; ++frame)
        for (const std::string& name : all) {
            const std::string path = frame_path(name, frame, numbered);
            // Names of files that are not there yet clash in all frames or in none.
            std::error_code ignored;
            const bool there = std::filesystem::exists(
                std::filesystem::symlink_status(std::filesystem::path(path), ignored));
            if (frame == options.first_frame || there) add_fault(check.writes(path), faults);
        }
    return faults;
}

/// Finds what would make writing fail before the work is done.
Status check_outputs(const Outputs& outputs, const Scene& scene, const RenderOptions& options) {
    Status faults;
    std::vector<std::string> all = outputs.files;
    all.insert(all.end(), outputs.world_files.begin(), outputs.world_files.end());
    if (!outputs.report.empty()) all.push_back(outputs.report);
    if (!options.state.empty()) all.push_back(options.state);
    std::vector<std::string> sound;
    for (const std::string& name : all) {
        const Status status = name.empty() ? Status::ok() : check_file_name(name);
        add_fault(status ? status : Status::io(status.message), faults);
        if (status) sound.push_back(name);
    }
    add_fault(check_names(sound, outputs.numbered, scene, options), faults);
    PILEUS_TRY(faults);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Status format = i < outputs.files.size() ? can_write_image(all[i]) : Status::ok();
        add_fault(format, faults);
        if (format)
            add_fault(can_write_file(frame_path(all[i], options.first_frame, outputs.numbered)),
                      faults);
    }
    return faults;
}

/// "a.pgw" of "a.png"; "a.wld" of the others, which readers of maps look for, too.
std::string world_name(const std::string& picture) {
    const std::string extension = file_extension(picture);
    return picture.substr(0, picture.size() - extension.size()) +
           (extension == ".png" ? ".pgw" : ".wld");
}

/// World files are for pictures that are maps.
Status add_world_files(const RenderArguments& arguments, const Scene& scene, Outputs& outputs) {
    if (!arguments.world_file) return Status::ok();
    Scene placed = scene;
    PILEUS_TRY(place_camera(placed));
    if (picture_place(placed, placed.camera, 0).empty())
        return Status::bad_input(scene.file +
                                 ": --world-file: no map, allowed: an orthographic camera that "
                                 "looks straight down on weather data");
    for (const std::string& file : outputs.files) {
        const std::string name = world_name(file);
        bool known = false;  // a.exr and a.pfm have one
        for (const std::string& other : outputs.world_files) known = known || other == name;
        if (!known) outputs.world_files.push_back(name);
    }
    return Status::ok();
}

/// Its six numbers, a line each.
std::string world_text(const Image& image) {
    std::string text;
    for (const auto& [name, value] : image.origin)
        if (name == "world_file") text = value + '\n';
    for (char& c : text)
        if (c == ' ') c = '\n';
    return text;
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

/// Options win over the scene; faults of all options come before those of the files.
Status read_arguments(const RenderArguments& arguments, Scene& scene, RenderOptions& options,
                      Outputs& outputs) {
    Status faults;
    if (arguments.show) {
        const Method* view = nullptr;
        add_fault(find_view("", *arguments.show, view), faults);
        if (arguments.exposure && view != nullptr && !view->shows_light)
            add_fault(Status::bad_input("--exposure: a view's colours are no light, allowed: leave "
                                        "it out, or --show illumination"),
                      faults);
        options.show = *arguments.show;
    }
    if (arguments.exposure)
        add_fault(read_exposure("--exposure", *arguments.exposure, outputs.tone), faults);
    add_fault(read_state(arguments, options), faults);
    if (arguments.verify)
        add_fault(read_integer("--verify", *arguments.verify, 1, kMostVerified, options.verify),
                  faults);
    if (arguments.verify && arguments.show)
        add_fault(Status::bad_input("--verify: a view is no picture of light, allowed: without "
                                    "--show"),
                  faults);
    add_fault(read_block_arguments(arguments.blocks, outputs.blocks), faults);
    add_fault(read_scene_options(arguments.scene, scene, options), faults);
    PILEUS_TRY(faults);

    const int frames = scene.animation.present ? scene.animation.frames : 1;
    options.last_frame = frames - 1;
    if (arguments.frames)
        PILEUS_TRY(read_frames(*arguments.frames, frames, options.first_frame, options.last_frame));
    outputs.numbered = frames > 1;
    // Blocks are all that such a run writes.
    if (!outputs.blocks.file.empty()) {
        if (!arguments.files.empty() || arguments.report)
            return Status::bad_input("--blocks: together with -o or --report, allowed: without");
        return check_names({outputs.blocks.file}, false, scene, options);
    }
    // Names on the command line start at the working directory, those in a scene at its folder.
    outputs.files = arguments.files;
    if (outputs.files.empty())
        for (const std::string& file : scene.output.files)
            outputs.files.push_back(scene_path(scene.directory, file));
    // -o stands for all that the scene would write: its report is of another picture.
    const bool own_report = arguments.files.empty() && !scene.output.report.empty();
    outputs.report_printed = arguments.report && *arguments.report == "-";
    if (arguments.report && !outputs.report_printed) outputs.report = *arguments.report;
    if (!arguments.report && own_report)
        outputs.report = scene_path(scene.directory, scene.output.report);
    options.digests = !outputs.report.empty() || outputs.report_printed;
    if (outputs.files.empty() && !options.digests)
        return Status::bad_input(scene.file +
                                 ": output.files: no output, allowed: -o FILE, --report FILE or "
                                 "output.files in the scene");
    PILEUS_TRY(add_world_files(arguments, scene, outputs));
    return check_outputs(outputs, scene, options);
}

Status write_frame(const Outputs& outputs, int frame, const Image& image, const Report& report) {
    OutputSet set;
    std::string lines;
    for (const std::string& file : outputs.files) {
        const std::string path = frame_path(file, frame, outputs.numbered);
        PILEUS_TRY(set.add_image(image, path, outputs.tone));
        lines += fmt::format("{} {}\n", image.pixel_hash, path);
    }
    const std::string world = world_text(image);
    for (const std::string& file : outputs.world_files) {
        const std::string path = frame_path(file, frame, outputs.numbered);
        PILEUS_TRY(set.add(path, {world.data(), world.size()}));
        lines += fmt::format("{:16} {}\n", "world file", path);
    }
    if (!outputs.report.empty()) {
        const std::string path = frame_path(outputs.report, frame, outputs.numbered);
        PILEUS_TRY(set.add_report(report, path));
        lines += fmt::format("{:16} {}\n", "report", path);
    }
    if (report.verified_pixels > 0)
        lines += fmt::format(
            "{:16} bias {:+.2f} % with a standard error of {:.2f} %, relMSE {:.2g}, over "
            "{} pixels\n",
            "verify", 100 * report.verify_bias, 100 * report.verify_standard_error,
            report.verify_relmse, report.verified_pixels);
    if (outputs.report_printed) lines = report_json(report);
    return set.commit(lines);
}

/// What there is of a picture that the user did not let finish.
std::string interrupted_line(int frame, bool numbered, const Report& report) {
    const std::string where = numbered ? fmt::format("frame {}: ", frame) : std::string();
    if (report.samples_per_pixel > 0)
        return fmt::format("{}interrupted: {} samples per pixel", where, report.samples_per_pixel);
    return fmt::format("{}interrupted: {} generations, {} photons", where, report.generations,
                       report.photons);
}

/// Says each warning once, whatever frame has it; returns whether there are any.
bool tell_warnings(const Report& report, std::set<std::string>& told) {
    for (const std::string& warning : report.warnings)
        if (told.insert(warning).second) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    return !report.warnings.empty();
}

Status run_render(RenderArguments& arguments) {
    const double start = wall_seconds();
    Scene scene;
    RenderOptions options;
    Outputs outputs;
    take_scene(arguments);
    PILEUS_TRY(read_arguments(arguments, scene, options, outputs));

    Progress progress(!arguments.quiet && stderr_is_terminal());
    options.progress = [&progress](const char* stage, double share) {
        progress.tell(stage, share);
    };
    std::string ended;
    std::set<std::string> told;
    bool doubtful = false;
    catch_interrupts("interrupted before there was anything to keep; no file written",
                     int(Code::kCheckFailed));
    options.interrupted = interrupt_asked;
    options.holding = hold_interrupts;
    if (!outputs.blocks.file.empty()) {
        Status status = render_blocks(scene, options, outputs.blocks);
        progress.clear();
        return status;
    }
    const int count = options.last_frame - options.first_frame + 1;
    const double tracing = wall_seconds();
    progress.frames(0, count, 0);
    const Status status =
        render(scene, options, [&](int frame, Image& image, Report& report) -> Status {
            progress.clear();
            if (image.pixel_hash.empty()) image.pixel_hash = pixel_hash(image);
            if (report.hash.empty()) report.hash = image.pixel_hash;
            if (report.interrupted) ended = interrupted_line(frame, outputs.numbered, report);
            PILEUS_TRY(write_frame(outputs, frame, image, report));
            doubtful = tell_warnings(report, told) || doubtful;
            progress.frames(frame - options.first_frame + 1, count, wall_seconds() - tracing);
            return Status::ok();
        });
    progress.clear();
    PILEUS_TRY(status);
    hold_interrupts(true);
    if (!arguments.quiet && !outputs.report_printed)
        PILEUS_TRY(print(fmt::format("{:16} {:.3f} s\n", "total", wall_seconds() - start)));
    return {doubtful && arguments.strict ? Code::kCheckFailed : Code::kOk, ended};
}

}  // namespace

void add_render(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand("render", "Render a scene to pictures and a report");
    const auto arguments = std::make_shared<RenderArguments>();
    add_scene_options(*command, arguments->scene,
                      "pileus render cloud.toml -o cloud.exr cloud.png --report cloud.json "
                      "--set sun.elevation_deg=10");
    add_quality_option(*command, arguments->scene);
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
    command
        ->add_option("--exposure", arguments->exposure,
                     "Brightness of .png and .ppm in stops, or auto; left out: 0")
        ->type_name("STOPS|auto");
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
    command->add_flag("--strict", arguments->strict,
                      "Exit status 1 where a picture has warnings; it is written all the same");
    command->add_flag("--world-file", arguments->world_file,
                      "Write the place of a map beside each picture: .pgw of .png, .wld of others");
    command->add_flag("-q,--quiet", arguments->quiet, "No progress and no total");
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_render(*arguments); }; });
}

}  // namespace pileus
