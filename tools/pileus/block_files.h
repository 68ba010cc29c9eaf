// SPDX-License-Identifier: Apache-2.0
// Files of blocks: `pileus render --blocks` writes one, `pileus compare --welch` compares two.
// in: options -> out: a file; lines or JSON, exit 1 where the means differ.
// docs/crosscheck.md
#pragma once
#include <optional>
#include <string>

#include "src/session/render.h"

namespace pileus {

/// As typed.
struct BlockArguments {
    std::optional<std::string> file, passes, side;
};

/// What the options mean.
struct BlockSettings {
    std::string file;  ///< empty: not asked for
    std::int64_t passes = 16, side = 8;
};

/// Faults of all three options; the file must be one that can be written.
Status read_block_arguments(const BlockArguments& arguments, BlockSettings& settings);

/// Renders a scene of one frame `passes` times, with seeds from its own on, and writes the blocks.
Status render_blocks(const Scene& scene, const RenderOptions& options,
                     const BlockSettings& settings);

/// Compares two files of blocks. kCheckFailed: the means differ.
Status compare_blocks(const std::string& a, const std::string& b,
                      const std::optional<std::string>& significance, bool json);

}  // namespace pileus
