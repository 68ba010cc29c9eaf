// SPDX-License-Identifier: Apache-2.0
// render --tiles: a picture larger than memory, band by band into a tiled .exr.
// in: a scene -> out: one file, and a report. docs/program.md, "Pictures larger than memory"
#pragma once
#include <string>
#include <vector>

#include "src/session/render.h"
#include "tools/pileus/part_files.h"
#include "tools/pileus/render_outputs.h"

namespace pileus {

/// Pixels along a tile's side. kBadInput: none of 8 to 4096, or outputs that no such file is.
Status read_tiles(const std::vector<std::string>& files, PartArguments& arguments);

Status render_tiles(const Scene& scene, const RenderOptions& options, const Outputs& outputs,
                    int side);

}  // namespace pileus
