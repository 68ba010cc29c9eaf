// SPDX-License-Identifier: Apache-2.0
// Films in parts: rows of one that several runs trace.
// in: a film, or light of a part -> out: light of a part, or its rows in the film. docs/farm.md
#pragma once
#include "src/methods/path/trace_paths.h"
#include "src/plan/part_light.h"
#include "src/run/work_share.h"

namespace pileus {

/// Pixels of all shares, and what all have counted together.
Status share_film(WorkShare& share, Film& film);

/// kBadInput: part of a pass is there. kLimit: out of memory.
Status take_film(const Film& film, PartLight& light);

/// As MethodReport::add_light. Samples of other seeds add up, each pixel's one
/// seed after the other. kBadInput: of another film.
Status add_film(const PartLight& light, const std::vector<int>& lines, bool counts, Film& film);

}  // namespace pileus
