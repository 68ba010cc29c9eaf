// SPDX-License-Identifier: Apache-2.0
// pileus new: a scene to start from.
// in: a type, a name -> out: a scene with comments, which renders as it is.
// docs/program.md, "new"
#include <filesystem>
#include <memory>
#include <optional>

#include "platform/fs_path.h"
#include "src/base/file.h"
#include "tools/pileus/command.h"
#include "tools/pileus/new_scene.h"
#include "tools/study/output_check.h"

namespace pileus {
namespace {

struct NewArguments {
    std::string type;
    std::optional<std::string> output;
    bool force = false;
};

Status run_new(const NewArguments& arguments) {
    if (arguments.type.empty() && !arguments.output && !arguments.force)
        return print(new_scene_lines());
    if (arguments.type.empty())
        return Status::bad_input(
            "pileus new: no type, allowed: TYPE before -o; alone it lists them");
    if (!arguments.output)
        return Status::bad_input("pileus new: no output, allowed: -o FILE.toml, or -o - to print");
    const std::string& name = *arguments.output;
    const bool printed = name == "-";
    if (printed && arguments.force)
        return Status::bad_input("--force: nothing is written over, allowed: with -o FILE.toml");
    const std::filesystem::path path = path_of(printed ? "" : name);
    std::string text;
    if (!printed) {
        PILEUS_TRY(check_file_name(name));
        if (file_extension(name) != ".toml")
            return Status::bad_input(name +
                                     ": extension: no scene, allowed: .toml, or -o - to print");
        OutputCheck check;
        if (is_new_scene_file(arguments.type)) check.reads(arguments.type, "the density");
        PILEUS_TRY(check.writes(name));
        std::error_code ignored;
        const auto status = std::filesystem::symlink_status(path, ignored);
        if (std::filesystem::exists(status) && !arguments.force)
            return Status::bad_input(name + ": is there, allowed: another name, or --force");
        PILEUS_TRY(can_write_file(name));
    }
    const std::string folder = path.has_parent_path() ? path_text(path.parent_path()) : ".";
    const std::string picture = printed
                                    ? (is_new_scene_file(arguments.type) ? "scene" : arguments.type)
                                    : path_text(path.stem());
    PILEUS_TRY(new_scene(arguments.type, folder, picture, text));
    if (printed) return print(text);
    PILEUS_TRY(write_file(name, {text.data(), text.size()}));
    return print("scene            " + name + '\n');
}

}  // namespace

void add_new(CLI::App& app, Chosen& chosen) {
    CLI::App* command = app.add_subcommand("new", "Write a scene to start from");
    const auto arguments = std::make_shared<NewArguments>();
    command->add_option("type", arguments->type, "Left out, with all else: lists the types")
        ->type_name("TYPE|FILE");
    command->add_option("-o,--output", arguments->output, "A scene, .toml; - prints it")
        ->type_name("FILE");
    command->add_flag("--force", arguments->force, "Write over a file that is there");
    command->footer(help_example("pileus new cumulus-congestus -o cloud.toml"));
    command->callback(
        [arguments, &chosen] { chosen = [arguments] { return run_new(*arguments); }; });
}

}  // namespace pileus
