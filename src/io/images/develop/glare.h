// SPDX-License-Identifier: Apache-2.0
// Glare: light of each pixel that lens and eye spread over the picture.
// in: planes of radiance -> out: the same planes.
// docs/exposure.md, "Glare"
#pragma once
#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

/// Spreads `share` of a plane's light, [0, 1], by a sum of four Gaussians of standard deviations
/// side/256, side/64, side/16 and side/4, each a quarter; `side` is the longer one of the picture,
/// in pixels. Edges reflect. What is not finite or below 0 spreads nothing and stays. Memory:
/// kLimit.
Status add_glare(int width, int height, double side, double share, Span<float> plane);

}  // namespace pileus
