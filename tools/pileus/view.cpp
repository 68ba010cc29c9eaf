// SPDX-License-Identifier: Apache-2.0
// pileus view: flies around a scene in a window.
// in: a scene, or none: the first picture -> out: pictures on a screen; screenshots.
// docs/view.md
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "src/base/file.h"
#include "src/base/printable.h"
#include "src/scene/toml/toml_tree.h"
#include "tools/pileus/command.h"
#include "tools/view/default_scene.h"
#include "tools/view/viewer.h"

namespace pileus {
namespace {

constexpr std::uint64_t kMaxScriptBytes = 1 << 20;

struct ViewArguments {
    view::Settings settings;
    std::string size = "1280x720", script;
    bool quiet = false;
};

Status read_size(const std::string& text, int& width, int& height) {
    char extra = 0;
    if (std::sscanf(text.c_str(), "%5dx%5d%c", &width, &height, &extra) != 2 || width < 16 ||
        height < 16 || width > 16384 || height > 16384)
        return Status::bad_input("--size: " + quote_text(text) +
                                 ", allowed: WIDTHxHEIGHT, 16 to 16384 each");
    return Status::ok();
}

Status run_view(ViewArguments& arguments) {
    view::Settings& s = arguments.settings;
    PILEUS_TRY(read_size(arguments.size, s.width, s.height));
    if (!(s.fps >= 1 && s.fps <= 1000)) return Status::bad_input("--fps: allowed: 1 to 1000");
    if (s.frames < 0) return Status::bad_input("--frames: allowed: 0 and more");
    if (s.path.empty()) {
        // Its picture is made by paths; marched, it is there at once.
        s.text = view::kDefaultScene;
        s.sets.insert(s.sets.begin(), {"method.name=raymarch", "filter.kind=none"});
    }
    std::unique_ptr<view::Window> window;
    if (!arguments.script.empty()) {
        Buffer<char> bytes;
        PILEUS_TRY(read_whole_file(arguments.script, kMaxScriptBytes, bytes));
        const Span<const char> text = without_mark(bytes.span());
        PILEUS_TRY(view::open_script_window({text.data, text.size}, s.width, s.height, window));
    } else {
        PILEUS_TRY(view::open_sdl_window(s.width, s.height, window));
    }
    view::Outcome outcome;
    PILEUS_TRY(view::run(s, *window, outcome));
    if (arguments.quiet) return Status::ok();
    std::string text = fmt::format("{} frames, the first lit after {:.2f} s\n", outcome.frames,
                                   outcome.first_lit_s);
    if (outcome.moving > 0)
        text += fmt::format("{} frames while things moved, median {:.1f} ms\n", outcome.moving,
                            1000 * outcome.moving_s);
    for (const std::string& file : outcome.screenshots) text += "screenshot " + file + '\n';
    return print(text);
}

}  // namespace

void add_view(CLI::App& app, Chosen& chosen) {
    const auto arguments = std::make_shared<ViewArguments>();
    CLI::App* command = app.add_subcommand("view", "fly around a scene in a window (F1: keys)");
    view::Settings& s = arguments->settings;
    command->add_option("SCENE", s.path, "scene file; left out: the first picture's");
    command->add_option("--set", s.sets, "KEY=VALUE: change a key of the scene");
    command->add_option("--threads", s.threads, "0: as many as there are processors");
    command->add_option("--size", arguments->size, "of the window, WIDTHxHEIGHT");
    command->add_option("--fps", s.fps, "frame rate that quality adapts to while things move");
    command->add_option("--frames", s.frames, "end after so many");
    command->add_option("--script", arguments->script,
                        "play events from a file, without a window (docs/view.md)");
    command->add_option("--screenshots", s.screenshots, "files of Ctrl+P: this and a number");
    command->add_flag("--hold", s.hold, "trace no light before the space bar");
    command->add_flag("--fixed-exposure", s.fixed_exposure, "the eye does not adapt");
    command->add_flag("--quiet", arguments->quiet, "say nothing at the end");
    command->footer(help_example("pileus view cloud.toml --fps 30"));
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_view(*arguments); }; });
}

}  // namespace pileus
