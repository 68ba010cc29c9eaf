// SPDX-License-Identifier: Apache-2.0
// The options of how .png and .ppm show a picture; `render`, `merge` and `compare` share them.
// in: texts from the command line -> out: checked settings.
// docs/exposure.md
#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/base/status.h"
#include "src/io/images/develop/tone_settings.h"

namespace pileus {

/// As typed.
struct ToneArguments {
    std::optional<std::string> exposure, tone, white_balance, glare;

    /// The first option that was given; null: none.
    const char* given() const;
};

/// Adds --exposure --tone --white-balance --glare to a subcommand. `exposure_help`: of the first.
void add_tone_options(CLI::App& command, ToneArguments& arguments,
                      const std::string& exposure_help);

/// Checks all of them; kBadInput, a line for each that is wrong.
Status read_tone(const ToneArguments& arguments, ToneSettings& tone);

/// kBadInput: an option is given, though the colours are no light.
Status refuse_tone(const ToneArguments& arguments);

/// kBadInput: an option is given that shows in none of these files.
Status check_tone_files(const ToneArguments& arguments, const std::vector<std::string>& files);

/// "exposure 1, tone agx, white balance 4500, glare 0.1": those that are given.
std::string tone_text(const ToneArguments& arguments);

}  // namespace pileus
