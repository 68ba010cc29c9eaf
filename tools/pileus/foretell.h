// SPDX-License-Identifier: Apache-2.0
// How long a rendering will take, by two small ones.
// in: a scene, options -> out: expected seconds.
// docs/program.md, "plan"
#pragma once
#include "src/session/render.h"

namespace pileus {

/// Of all frames from options.first_frame to options.last_frame. Renders two frames at most with a
/// 64th and then a 16th of the pixels and photons; what grows between the two goes on growing,
/// stage by stage. Files that are written are not in it. kBadInput: a budget of seconds or of an
/// error, which are no amount of work; else as render's.
Status foretell_time(const Scene& scene, const RenderOptions& options, ForetoldTime& out);

}  // namespace pileus
