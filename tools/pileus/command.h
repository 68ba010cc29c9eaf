// SPDX-License-Identifier: Apache-2.0
// What the subcommands share with main: how each adds itself, and how it says things.
// in: an empty command line -> out: a line with options, and the work that the user chose.
// docs/program.md
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "src/base/status.h"

namespace pileus {

/// The work of the subcommand that was on the command line; called after parsing.
using Chosen = std::function<Status()>;

// Each adds one subcommand to `app`; its presence on the command line sets `chosen`.
void add_render(CLI::App& app, Chosen& chosen);
void add_plan(CLI::App& app, Chosen& chosen);
void add_follow(CLI::App& app, Chosen& chosen);
void add_flux(CLI::App& app, Chosen& chosen);
void add_compare(CLI::App& app, Chosen& chosen);
void add_hash(CLI::App& app, Chosen& chosen);
void add_info(CLI::App& app, Chosen& chosen);
void add_convert(CLI::App& app, Chosen& chosen);
void add_study(CLI::App& app, Chosen& chosen);
void add_view(CLI::App& app, Chosen& chosen);
void add_pack(CLI::App& app, Chosen& chosen);
void add_merge(CLI::App& app, Chosen& chosen);
void add_methods(CLI::App& app, Chosen& chosen);
void add_new(CLI::App& app, Chosen& chosen);

/// The end of a subcommand's help.
inline std::string help_example(const std::string& line) { return "Example:\n  " + line; }

/// Writes `text` to the standard output at once; a full disk or a closed pipe: kIo.
Status print(const std::string& text);

}  // namespace pileus
