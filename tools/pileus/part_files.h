// SPDX-License-Identifier: Apache-2.0
// Parts of a picture in files: render --part writes them, merge puts them together.
// in: "2/8", a scene -> out: a file; in: files -> out: the picture. docs/farm.md
#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/session/parts/parts.h"

namespace pileus {

/// As typed.
struct PartArguments {
    std::optional<std::string> part, tiles, stage;
    int tile_side = 0;  ///< of --tiles; 0: without

    bool given() const { return part || tiles; }
};

/// Adds --part, --tiles and --stage to a subcommand.
void add_part_options(CLI::App& command, PartArguments& arguments);

/// Frames that one process best renders of a film, which is divided by whole frames; 0: a picture,
/// which is divided itself.
int divided_run(const Scene& scene);

/// Reads "I/N" of --part, 1 <= I <= N; `run` is divided_run.
Status choose_part(const PartArguments& arguments, int run, RenderOptions& options);
Status choose_part(const std::string& text, int run, RenderOptions& options);

/// Whether a part of a picture is asked for.
inline bool is_part(const RenderOptions& options) { return options.part.given; }

/// One output, whose name ends in .part, and which nothing else is.
Status check_part_file(const std::vector<std::string>& files, const RenderOptions& options,
                       const Scene& scene);

/// All of them, in their order; photons of one work are added up as they come. kBadInput: none.
Status read_part_files(const std::vector<std::string>& files, std::vector<Part>& parts);

Status write_part(const Scene& scene, const RenderOptions& options, const std::string& file);

}  // namespace pileus
