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

namespace pileus {

/// As typed.
struct SceneArguments {
    std::string scene;
    std::optional<std::string> threads, seed, isa, quality;
    std::vector<std::string> sets, budgets, limits;
};

/// Adds SCENE --set --threads --seed --isa --budget --limit to a subcommand; its help ends with the
/// example and the limits.
void add_scene_options(CLI::App& command, SceneArguments& arguments, const std::string& example);

/// Adds --quality, for commands that make pictures.
void add_quality_option(CLI::App& command, SceneArguments& arguments);

/// Checks all options, reads the scene and applies overrides and seed. Faults: one line each,
/// those of the options first; kBadInput, or what reading the scene gave.
Status read_scene_options(const SceneArguments& arguments, Scene& scene, RenderOptions& options);

}  // namespace pileus
