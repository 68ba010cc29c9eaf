// SPDX-License-Identifier: Apache-2.0
// The end of a frame: its hash, what made it, the clocks, and the way to whoever asked for it.
// in: a picture with its layers, a report -> out: both complete, handed to the sink.
// docs/formats.md, "Pictures out"; docs/report.md
#pragma once
#include "platform/clock.h"
#include "src/run/context.h"
#include "src/session/render.h"
#include "src/session/session.h"

namespace pileus {

/// The clocks when rendering began.
struct RunStart {
    double wall_s = wall_seconds(), cpu_s = cpu_seconds();
};

/// Lights and draws a frame with all of its layers.
Status draw_frame(const Scene& scene, Session& session, const FilmFrame& step, Image& image);
/// Of these layers those that are of surfaces, of a frame that was drawn: reflectance, shadow.
Status add_surface_layers(const Scene& scene, const Session& session, int frame, Image& image);

/// Names the picture by its bits before anything else is written about it.
void take_hash(const Context& context, const Image& image, Report& report);

/// What it has taken since then.
void finish_clocks(const RunStart& start, Report& report);

/// What another run needs, beside the scene's text, to make the same picture. Nothing of the
/// machine.
void note_origin(const Report& report, Image& image);

/// Completes a frame's picture and report, and hands both over.
Status deliver(const Scene& scene, const RunStart& start, int frame, const FrameSink& sink,
               Image& image, Report& report);

}  // namespace pileus
