// SPDX-License-Identifier: Apache-2.0
// Steps of method `collectors` instead of its picture; and what both kinds of rendering share.
// in: a lit or half prepared run -> out: images and reports, handed to the caller frame by frame.
// docs/how-it-works.md
#pragma once
#include "src/session/run_context.h"

namespace pileus {

/// The clocks when rendering began.
struct RunStart {
    RunStart();
    double wall_s, cpu_s;
};

/// Names the picture by its bits before anything else is written about it.
void take_hash(const Image& image, Report& report);

/// Completes a frame's picture and report, and hands both over.
Status deliver(const Scene& scene, const RunStart& start, int frame, const FrameSink& sink,
               Image& image, Report& report);

/// Draws options.show for each frame. kBadInput: no such view, or not of this method.
Status render_views(const Scene& scene, const RenderOptions& options, const Context& context,
                    const Frames& frames, const FrameSink& sink);

}  // namespace pileus
