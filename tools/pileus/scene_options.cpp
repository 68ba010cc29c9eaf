// SPDX-License-Identifier: Apache-2.0
// Reads and checks the options that `render` and `plan` share.
// in: texts from the command line -> out: see scene_options.h.
// docs/program.md
#include "tools/pileus/scene_options.h"

#include <cstdint>
#include <limits>

#include "src/base/limits.h"
#include "src/run/find_kernels.h"
#include "src/scene/read_scene.h"
#include "src/scene/toml/toml_tree.h"
#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/quality.h"

namespace pileus {

namespace {

constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMaxSamples = std::int64_t{1} << 32;
constexpr double kMaxSeconds = 1e9;
constexpr std::int64_t kMaxSteps = 65536;

Status check_isa(const std::string& name) {
    const KernelTable* kernels = nullptr;
    return find_kernels(name, kernels);
}

Status read_budget(const std::string& text, RenderOptions& options) {
    const std::size_t equals = text.find('=');
    const std::string kind = text.substr(0, equals);
    const std::string amount = equals == std::string::npos ? "" : text.substr(equals + 1);
    if (kind == "photons")
        return read_integer("--budget photons", amount, 0, kMax, options.budget.photons);
    if (kind == "seconds")
        return read_number("--budget seconds", amount, 1e-3, kMaxSeconds, options.budget.seconds);
    if (kind == "generations")
        return read_integer("--budget generations", amount, 1, kMax, options.budget.generations);
    if (kind == "samples")
        return read_integer("--budget samples", amount, 1, kMaxSamples, options.budget.samples);
    if (kind == "error")
        return read_number("--budget error", amount, 1e-6, 1, options.budget.error);
    if (kind == "steps")
        return read_integer("--budget steps", amount, 0, kMaxSteps, options.budget.steps);
    return Status::bad_input(
        "--budget: unknown kind, " + quote_text(text) +
        ", allowed: photons=N, generations=N, samples=N, steps=N, error=E, seconds=S");
}

/// Of a file, or of a picture, whose own --set come first.
Status read_any_scene(const SceneArguments& arguments, const std::vector<std::string>& sets,
                      Scene& scene) {
    if (arguments.scene.empty())
        return Status::bad_input("SCENE.toml: missing, allowed: the path of a scene");
    if (!arguments.picture) return read_scene_file(arguments.scene, sets, scene);
    const PictureScene& picture = *arguments.picture;
    std::vector<std::string> all = picture.overrides;
    all.insert(all.end(), sets.begin(), sets.end());
    return read_scene_text(picture.text, picture.file, picture.directory, all, scene);
}

/// The budgets of a picture's run, where it is made again by its own method.
Status repeat_budgets(const SceneArguments& arguments, const Scene& scene, RenderOptions& options) {
    const PictureScene& picture = *arguments.picture;
    if (!arguments.budgets.empty() || scene.method != picture.method) return Status::ok();
    if (!picture.unrepeatable.empty())
        return Status::bad_input(picture.file + ": cannot be made again, " + picture.unrepeatable +
                                 ", allowed: --budget");
    Status faults;
    for (const std::string& budget : picture.budgets) {
        Status status = read_budget(budget, options);
        if (!status) status.message = picture.file + ": pileus.budget: " + status.message;
        add_fault(status, faults);
    }
    return faults;
}

/// The scene, read again with what its quality adds.
Status read_quality(const SceneArguments& arguments, Scene& scene) {
    std::vector<std::string> sets;
    PILEUS_TRY(quality_sets(*arguments.quality, scene, arguments.sets, sets));
    sets.insert(sets.end(), arguments.sets.begin(), arguments.sets.end());
    scene = Scene();
    return read_any_scene(arguments, sets, scene);
}

}  // namespace

Status take_picture(SceneArguments& arguments) {
    if (is_picture_scene(arguments.scene)) {
        PictureScene picture;
        PILEUS_TRY(read_picture_scene(arguments.scene, arguments.folder, picture));
        arguments.picture = std::move(picture);
        return Status::ok();
    }
    if (!arguments.folder) return Status::ok();
    return Status::bad_input("--folder: " + quote_text(arguments.scene) +
                             " is no picture, allowed: with an .exr file in place of a scene");
}

bool is_changed(const SceneArguments& arguments) {
    return arguments.seed || arguments.quality || !arguments.sets.empty() ||
           !arguments.budgets.empty();
}

void add_scene_options(CLI::App& command, SceneArguments& arguments, const std::string& example) {
    command.add_option("scene", arguments.scene, "The scene file")->type_name("SCENE.toml");
    command
        .add_option("--set", arguments.sets,
                    "Put a value into the scene, e.g. medium.0.albedo=0.9; may be repeated")
        ->allow_extra_args(false)
        ->type_name("KEY=VALUE");
    command.add_option("--threads", arguments.threads, "Threads; left out: all there are")
        ->type_name("N");
    command.add_option("--seed", arguments.seed, "Another seed than the scene's")->type_name("N");
    command.add_option("--isa", arguments.isa, "Instruction set; left out: the widest")
        ->type_name("NAME");
    command
        .add_option("--budget", arguments.budgets,
                    "photons=N (collectors) or generations=N of them, samples=N for each pixel "
                    "(path) or steps=N of a ray "
                    "(raymarch) instead of the scene's number; error=E (path) ends at a mean "
                    "relative standard error; "
                    "seconds=S ends tracing after that time, between two passes; may be repeated: "
                    "what comes first ends it")
        ->allow_extra_args(false)
        ->type_name("KIND=N");
    command
        .add_option("--limit", arguments.limits,
                    "What the scene may ask for, e.g. memory=16Gi; may be repeated; the names are "
                    "listed below")
        ->allow_extra_args(false)
        ->type_name("NAME=N");
    command.footer(help_example(example) + "\n\nLimits, by default (and at most):\n" +
                   describe_limits());
}

void add_picture_options(CLI::App& command, SceneArguments& arguments) {
    command.get_option("scene")->description(
        "The scene file, or an .exr picture, to make it again");
    command
        .add_option("--folder", arguments.folder,
                    "Where names in the scene of an .exr picture start; left out: as the picture "
                    "says, or its own folder")
        ->type_name("DIR");
    command
        .add_option_function<std::string>(
            "--crop",
            [&arguments](const std::string& pixels) {
                arguments.sets.push_back("camera.crop=[" + pixels + "]");
            },
            "Only these pixels of the picture, with the bits that they have in it: columns x0 to "
            "x1 - 1, rows y0 to y1 - 1 from the top")
        ->type_name("X0,Y0,X1,Y1");
    command
        .add_option("--quality", arguments.quality,
                    "draft: a first look, few samples and filtered; final: nothing filtered or "
                    "thinned out; left out: as the scene says. --set and --budget count more")
        ->type_name("draft|final");
}

Status read_scene_options(const SceneArguments& arguments, Scene& scene, RenderOptions& options) {
    Status faults;
    if (arguments.threads) {
        std::int64_t threads = 0;
        add_fault(read_integer("--threads", *arguments.threads, 1, kMaxThreads, threads), faults);
        options.threads = int(threads);
    }
    if (arguments.isa) add_fault(check_isa(*arguments.isa), faults);
    options.isa = arguments.isa.value_or("");
    for (const std::string& budget : arguments.budgets)
        add_fault(read_budget(budget, options), faults);
    for (const std::string& limit : arguments.limits)
        add_fault(set_limit(limit, options.limits), faults);
    std::int64_t seed = 0;
    if (arguments.seed) add_fault(read_integer("--seed", *arguments.seed, 0, kMax, seed), faults);
    add_fault(read_any_scene(arguments, arguments.sets, scene), faults);
    PILEUS_TRY(faults);
    if (arguments.quality) PILEUS_TRY(read_quality(arguments, scene));
    if (arguments.picture) scene.seed = arguments.picture->seed;
    if (arguments.seed) scene.seed = seed;
    return arguments.picture ? repeat_budgets(arguments, scene, options) : Status::ok();
}

}  // namespace pileus
