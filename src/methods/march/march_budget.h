// SPDX-License-Identifier: Apache-2.0
// Chooses how many pixels and steps a marched picture has for a wall time.
// in: a march that is ready to go, seconds that are left -> out: settings of it.
// docs/raymarch.md, "A time instead of steps"
#pragma once
#include "src/methods/march/march_state.h"

namespace pileus {

/// Marches one pixel in 256 to see what they cost, then takes the finest scale, and where even one
/// pixel in 16 is too dear the most steps, that fit into what is left since `start_s`. Nothing
/// where the budget has no seconds. The choice is in state.choice.settings; pictures by it have the
/// bits of scenes with these settings.
Status choose_march_work(const Context& context, const FrameView& view, double start_s,
                         const UpsampleInput& in, MarchState& state);

}  // namespace pileus
