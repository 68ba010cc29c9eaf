// SPDX-License-Identifier: Apache-2.0
// What a raw grid does not say itself, as options of the subcommands that touch one.
// in: --size, --type, --big-endian -> out: the fields of MediumSettings that describe a raw file.
// docs/program.md
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "src/io/volumes/volume_file.h"

namespace pileus {

struct RawOptions {
    std::vector<std::string> size;  ///< as written
    std::string type = "float32";
    bool big_endian = false;
};

void add_raw_options(CLI::App& command, RawOptions& options);

/// Reads --type; else kBadInput.
Status read_raw_type(const RawOptions& options, RawType& type);

/// Everything about a raw grid to be read; `file` opens the line of a missing size.
Status read_raw_facts(const std::string& file, const RawOptions& options, MediumSettings& medium);

}  // namespace pileus
