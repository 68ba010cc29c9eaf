// SPDX-License-Identifier: Apache-2.0
// What a sea mirrors: sky and clouds all around, as they are seen from the camera's mirror image.
// in: a lit MarchState -> out: a map of radiance over the upper half of directions.
// docs/ground.md, "Sea"
#pragma once
#include "src/methods/march/march_state.h"

namespace pileus {

/// Fills state.picture.mirror with what `whole` marches under `light`, but for solids; nothing
/// where there is no sea or none of it is seen. Errors: raymarch_picture's.
Status mirror_sky(const Context& context, const FrameView& view, const RaymarchInput& whole,
                  const Lighting& light, MarchState& state);

}  // namespace pileus
