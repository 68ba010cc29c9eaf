// SPDX-License-Identifier: Apache-2.0
// One call from a checked scene with [clouds] to pictures: what the program and tests use.
// in: Scene, options -> out: an Image per frame and a Report.
// docs/clouds.md, "In a scene file"
#pragma once
#include "src/session/render.h"

namespace pileus {

/// As render (src/session/render.h) for a scene with [clouds]: each frame goes on from the one
/// before. Of the options threads, isa, limits, frames, progress and holding count. Errors: as
/// render's, and those of the kinds' scenes.
Status render_clouds(const Scene& scene, const RenderOptions& options, const FrameSink& sink);

}  // namespace pileus
