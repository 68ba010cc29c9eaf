// SPDX-License-Identifier: Apache-2.0
// The end of a frame: its hash, what made it, the clocks, and the way to whoever asked for it.
// in: a picture with its layers, a report -> out: both complete, handed to the sink.
// docs/formats.md, "Pictures out"; docs/report.md
#pragma once
#include "platform/clock.h"
#include "src/run/context.h"
#include "src/session/render.h"

namespace pileus {

/// The clocks when rendering began.
struct RunStart {
    double wall_s = wall_seconds(), cpu_s = cpu_seconds();
};

/// Names the picture by its bits before anything else is written about it.
void take_hash(const Context& context, const Image& image, Report& report);

/// Completes a frame's picture and report, and hands both over.
Status deliver(const Scene& scene, const RunStart& start, int frame, const FrameSink& sink,
               Image& image, Report& report);

}  // namespace pileus
