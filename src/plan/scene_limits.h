// SPDX-License-Identifier: Apache-2.0
// What a scene asks for in so many words, against the limits.
// in: a checked scene -> out: kLimit with one line, before anything is read or allocated.
// docs/program.md, "Limits".
#pragma once
#include "src/base/limits.h"
#include "src/scene/scene.h"

namespace pileus {

/// Media, pixels, frames, generations and samples; photons and voxels are checked where they are
/// worked out.
Status check_scene_limits(const Scene& scene, const Limits& limits);

}  // namespace pileus
