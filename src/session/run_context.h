// SPDX-License-Identifier: Apache-2.0
// What the calls of the API begin with: the context, the budget and the frames.
// in: Scene, RenderOptions -> out: checked structs for the methods.
// docs/architecture.md, "How a frame is made".
#pragma once
#include "src/methods/registry.h"
#include "src/session/render.h"

namespace pileus {

struct Frames {
    int first, last, total;
};

/// kBadInput: a scene with [clouds], which src/clouds draws.
Status refuse_clouds(const Scene& scene);

/// Chooses kernels and threads and fills the report's head. kBadInput: isa, threads, a scene with
/// [clouds]; kCheckFailed: kernels that give other bits than they must.
Status make_context(const Scene& scene, const RenderOptions& options, Context& context,
                    Report& report);

/// What a report begins with.
void note_head(const Scene& scene, const RenderOptions& options, const Context& context,
               Report& report);

/// kBadInput: frames that the scene does not have.
Status frames_of(const Scene& scene, const RenderOptions& options, Frames& frames);

/// What the session of a frame is opened with.
FrameState opened_at(const Scene& scene, int frame);

/// Texts of the budgets that make this frame's picture again, whatever ended it: a clock and an
/// error have come to whole samples or generations. Empty: the scene's own numbers, or a user who
/// ended it within a pass, which nothing repeats.
std::string budget_used(const MethodReport& method, const Budget& given, int frame,
                        const Report& report);

/// What the process and its stages have used up to now.
void take_clocks(Clocks& clocks);

}  // namespace pileus
