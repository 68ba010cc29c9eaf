// SPDX-License-Identifier: Apache-2.0
// The options that choose a scene and how it is computed; `render` and `plan` share them.
// in: texts from the command line -> out: a checked Scene and RenderOptions.
// docs/program.md
#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/session/render.h"
#include "tools/pileus/picture_scene.h"

namespace pileus {

/// As typed.
struct SceneArguments {
    std::string scene;
    std::optional<std::string> threads, seed, isa, quality, folder;
    std::vector<std::string> sets, budgets, limits;
    std::optional<PictureScene> picture;  ///< where the scene is that of a picture
};

/// Adds SCENE --set --threads --seed --isa --budget --limit to a subcommand; its help ends with the
/// example and the limits.
void add_scene_options(CLI::App& command, SceneArguments& arguments, const std::string& example);

/// Adds --quality and --folder, for commands that make pictures.
void add_picture_options(CLI::App& command, SceneArguments& arguments);

/// Reads the picture that stands for a scene, where it does. Errors: those of read_picture_scene; a
/// --folder of another scene: kBadInput.
Status take_picture(SceneArguments& arguments);

/// Whether options change what the picture would be.
bool is_changed(const SceneArguments& arguments);

/// Checks all options, reads the scene and applies overrides and seed. Faults: one line each,
/// those of the options first; kBadInput, or what reading the scene gave.
Status read_scene_options(const SceneArguments& arguments, Scene& scene, RenderOptions& options);

}  // namespace pileus
