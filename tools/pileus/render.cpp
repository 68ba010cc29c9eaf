// SPDX-License-Identifier: Apache-2.0
// pileus render: a scene to pictures and a report, frame after frame.
// in: a scene and options -> out: files; on stdout a line for each with its pixel hash.
// docs/program.md
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <set>

#include "platform/clock.h"
#include "platform/interrupt.h"
#include "src/base/file.h"
#include "src/methods/collectors/views/views.h"
#include "src/scene/read_scene.h"
#include "tools/pileus/block_files.h"
#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/output_set.h"
#include "tools/pileus/progress.h"
#include "tools/pileus/scene_options.h"

namespace pileus {

namespace {

constexpr double kMostStops = 64;

struct RenderArguments {
    SceneArguments scene;
    std::vector<std::string> files;
    std::optional<std::string> report, frames, exposure, show, state, state_every;
    BlockArguments blocks;
    bool quiet = false;
};

/// Everything a frame needs to be written.
struct Outputs {
    std::vector<std::string> files;
    std::string report;
    ToneSettings tone;
    BlockSettings blocks;
    bool numbered = false;  ///< the scene has several frames, so names carry the frame's number
};

std::string frame_path(const std::string& path, int frame, bool numbered) {
    return numbered ? numbered_path(path, frame) : path;
}

Status read_tone(const RenderArguments& arguments, ToneSettings& tone) {
    if (!arguments.exposure) return Status::ok();
    tone.automatic = *arguments.exposure == "auto";
    if (tone.automatic) return Status::ok();
    double stops = 0;
    Status status = read_number("--exposure", *arguments.exposure, -kMostStops, kMostStops, stops);
    if (!status) status.message += ", or auto";
    tone.stops = float(stops);
    return status;
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

/// Finds what would make writing fail before the work is done.
Status check_outputs(const Outputs& outputs, const std::string& scene, const std::string& state,
                     int frame) {
    Status faults;
    std::set<std::string> paths;
    std::vector<std::string> all = outputs.files;
    if (!outputs.report.empty()) all.push_back(outputs.report);
    if (!state.empty()) all.push_back(state);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string path = frame_path(all[i], frame, outputs.numbered);
        const Status name = all[i].empty() ? Status::ok() : check_file_name(all[i]);
        add_fault(name.code == Code::kOk ? name : Status::io(name.message), faults);
        if (!name) continue;
        std::error_code ignored;
        if (std::filesystem::equivalent(path, scene, ignored))
            add_fault(Status::bad_input(path + ": output: is the scene itself, allowed: another"),
                      faults);
        if (!paths.insert(all[i]).second)
            add_fault(Status::bad_input(all[i] + ": output: named twice, allowed: once"), faults);
        const Status format = i < outputs.files.size() ? can_write_image(all[i]) : Status::ok();
        add_fault(format, faults);
        if (format) add_fault(can_write_file(path), faults);
    }
    return faults;
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
        View view{};
        add_fault(find_view(*arguments.show, view), faults);
        if (arguments.exposure && !view_is_light(view))
            add_fault(Status::bad_input("--exposure: a view's colours are no light, allowed: leave "
                                        "it out, or --show illumination"),
                      faults);
        options.show = *arguments.show;
    }
    add_fault(read_tone(arguments, outputs.tone), faults);
    add_fault(read_state(arguments, options), faults);
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
        if (arguments.files.empty() && !arguments.report) return Status::ok();
        return Status::bad_input("--blocks: together with -o or --report, allowed: without");
    }
    // Names on the command line start at the working directory, those in a scene at its folder.
    outputs.files = arguments.files;
    if (outputs.files.empty())
        for (const std::string& file : scene.output.files)
            outputs.files.push_back(scene_path(scene.directory, file));
    if (arguments.report)
        outputs.report = *arguments.report;
    else if (!scene.output.report.empty())
        outputs.report = scene_path(scene.directory, scene.output.report);
    if (outputs.files.empty() && outputs.report.empty())
        return Status::bad_input(scene.file +
                                 ": output.files: no output, allowed: -o FILE, --report FILE or "
                                 "output.files in the scene");
    return check_outputs(outputs, arguments.scene.scene, options.state, options.first_frame);
}

Status write_frame(const Outputs& outputs, int frame, const Image& image, const Report& report) {
    OutputSet set;
    std::string lines;
    for (const std::string& file : outputs.files) {
        const std::string path = frame_path(file, frame, outputs.numbered);
        PILEUS_TRY(set.add_image(image, path, outputs.tone));
        lines += fmt::format("{} {}\n", image.pixel_hash, path);
    }
    if (!outputs.report.empty()) {
        const std::string path = frame_path(outputs.report, frame, outputs.numbered);
        PILEUS_TRY(set.add_report(report, path));
        lines += fmt::format("{:16} {}\n", "report", path);
    }
    PILEUS_TRY(set.commit());
    PILEUS_TRY(print(lines));
    set.keep();
    return Status::ok();
}

/// What there is of a picture that the user did not let finish.
std::string interrupted_line(int frame, bool numbered, const Report& report) {
    const std::string where = numbered ? fmt::format("frame {}: ", frame) : std::string();
    if (report.samples_per_pixel > 0)
        return fmt::format("{}interrupted: {} samples per pixel", where, report.samples_per_pixel);
    return fmt::format("{}interrupted: {} generations, {} photons", where, report.generations,
                       report.photons);
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
    catch_interrupts();
    options.interrupted = interrupt_asked;
    if (!outputs.blocks.file.empty()) {
        const Status status = render_blocks(scene, options, outputs.blocks);
        progress.clear();
        return status;
    }
    const Status status =
        render(scene, options, [&](int frame, Image& image, Report& report) -> Status {
            progress.clear();
            if (image.pixel_hash.empty()) image.pixel_hash = pixel_hash(image);
            if (report.hash.empty()) report.hash = image.pixel_hash;
            if (report.interrupted) ended = interrupted_line(frame, outputs.numbered, report);
            return write_frame(outputs, frame, image, report);
        });
    progress.clear();
    PILEUS_TRY(status);
    if (!arguments.quiet)
        PILEUS_TRY(print(fmt::format("{:16} {:.3f} s\n", "total", wall_seconds() - start)));
    return {Code::kOk, ended};
}

}  // namespace

void add_render(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand("render", "Render a scene to pictures and a report");
    const auto arguments = std::make_shared<RenderArguments>();
    add_scene_options(*command, arguments->scene);
    command
        ->add_option("-o,--output", arguments->files,
                     ".exr .png .pfm or .ppm, instead of the scene's output.files")
        ->type_name("FILE");
    command->add_option("--report", arguments->report, "JSON report to write")->type_name("FILE");
    command
        ->add_option("--frames", arguments->frames, "Frames of an animation, from 0; left out: all")
        ->type_name("A-B");
    command
        ->add_option("--exposure", arguments->exposure,
                     "Brightness of .png and .ppm in stops, or auto; left out: 0")
        ->type_name("STOPS|auto");
    command
        ->add_option("--show", arguments->show,
                     "A step of the method instead of its picture: gradient, samples, tree, "
                     "leaf-density, collectors, photons, illumination")
        ->type_name("VIEW");
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
    command->add_flag("-q,--quiet", arguments->quiet, "No progress and no total");
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_render(*arguments); }; });
}

}  // namespace pileus
