// SPDX-License-Identifier: Apache-2.0
// Whether the media of a run stand above the ground where a frame has them.
// in: a run whose world is outlined -> out: a fault with the frame, the place and what is allowed.
// docs/animation.md
#pragma once
#include "src/methods/methods.h"

namespace pileus {

/// kBadInput: below the ground at a frame, to which the run's `place_at`, where it has one, moves
/// them. `rest`: the ground as the scene's text has it.
Status check_placed_media(const MethodRun& run, const Ground& rest, int frame);

}  // namespace pileus
