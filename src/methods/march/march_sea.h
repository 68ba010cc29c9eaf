// SPDX-License-Identifier: Apache-2.0
// What a sea mirrors: sky and clouds all around, as they are seen from the camera's mirror image.
// in: a lit MarchState -> out: a map of radiance over the upper half of directions.
// docs/ground.md, "Sea"
#pragma once
#include "src/methods/march/march_state.h"

namespace pileus {

/// Fills `out`, which `map` then points into; nothing without a sea, or where none is seen. Errors:
/// raymarch_picture's.
Status mirror_sky(const Context& context, const FrameView& view, MarchState& state, SeaMirror& out);

}  // namespace pileus
