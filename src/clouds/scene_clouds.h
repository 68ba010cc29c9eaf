// SPDX-License-Identifier: Apache-2.0
// The clouds that a scene file asks for: its kinds read and prepared, its places taken and drawn.
// in: a scene with [clouds], the session of its sky -> out: clouds that stand in it.
// docs/clouds.md, "In a scene file"
#pragma once
#include "src/clouds/clouds.h"
#include "src/plan/report.h"

namespace pileus {

/// A session of the scene's sky alone, all but its clouds. Errors: as Session::open.
Status open_sky(const Scene& scene, const RenderOptions& options, Session& sky);

/// `told`: the kinds, and how many clouds of each. Errors name the key: kBadInput, kLimit, kIo of a
/// kind's scene and its files; no room for all clouds of a scatter.
Status open_scene_clouds(const Scene& scene, const RenderOptions& options, Session& sky,
                         Clouds& clouds, CloudCounts& told);

/// The same of clouds that are open.
Status fill_scene_clouds(const Scene& scene, const RenderOptions& options, Session& sky,
                         Clouds& clouds, CloudCounts& told);

}  // namespace pileus
