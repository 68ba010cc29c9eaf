// SPDX-License-Identifier: Apache-2.0
// A picture by several ranks: each works on a part, rank 0 puts them together.
// in: a scene -> out: at rank 0 the picture that one process makes; elsewhere nothing.
// docs/farm.md, "Ranks of MPI"
#pragma once
#include "src/session/render.h"

namespace pileus {

/// What of the work is each rank's, where there are several: all of it in parts, or of a film its
/// share of the frames, by `run` as choose_part has it. kBadInput: fewer frames than ranks.
Status share_ranks(bool has_threads, int run, RenderOptions& options);

/// As render; all ranks call it, with the same scene. A film's frames come one after the other to
/// whom they fall: `sink` is called by every rank.
Status render_by_ranks(const Scene& scene, const RenderOptions& options, const FrameSink& sink);

}  // namespace pileus
