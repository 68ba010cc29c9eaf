// SPDX-License-Identifier: Apache-2.0
// A picture of any size, band by band from the top, in memory that one band takes.
// in: a scene -> out: its bands, each with all layers, with the bits that they have in the whole.
// docs/program.md, "Pictures larger than memory"
#pragma once
#include <functional>

#include "src/session/render.h"

namespace pileus {

/// Rows `first_row` and on of the picture; `report` is complete with the last.
using BandSink = std::function<Status(int first_row, bool last, Image& band, Report& report)>;

/// Bands of `rows` rows, the last of what is left. kBadInput: what needs all of the picture at
/// once.
Status render_bands(const Scene& scene, const RenderOptions& options, int rows,
                    const BandSink& sink);

}  // namespace pileus
