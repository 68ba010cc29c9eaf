// SPDX-License-Identifier: Apache-2.0
// The film of one view: alpha, then samples.
// in: a view, what was prepared -> out: planes behind the film's light, its sums.
// docs/path.md
#include "src/methods/path/path_state.h"
#include "src/picture/march_view.h"
#include "src/run/work_share.h"

namespace pileus {
namespace {

/// What the medium shows along the rays through pixel centres; a flat detector has no such rays.
Status make_alpha(const Context& context, const FrameView& view, PathState& state) {
    const Scene& scene = view.scene;
    // Colours are the film's, and stay where they are.
    Buffer<float> colour;
    colour.swap(state.planes.colour);
    const Status room = allocate_planes(state.camera.width, state.camera.height, 0,
                                        view.lighting.opaque(), view.wants_depth(), state.planes);
    colour.swap(state.planes.colour);
    if (!room) return room;
    if (state.camera.flux != 0) return Status::ok();  // alpha 1: all pixels are measured
    const Medium& medium = view.world.medium;
    if (path_regresses(state.filter))
        return march_guides(context, medium, state.majorants, view.lighting, state.camera,
                            view.wants_depth(), state.planes, state.guides);
    const MarchWanted wanted{view.wants_depth(), scene.output.layer_optical_depth};
    return march_medium(context, medium, state.majorants, view.lighting, state.camera, wanted,
                        state.planes);
}

/// A host sees light before its media and behind, and no errors: but for layers, and a filter,
/// which reads all.
PathInput film_input(const Context& context, const FrameView& view, const PathState& state) {
    PathInput in = path_input(context, view, state);
    const OutputSettings& output = view.scene.output;
    const bool layers = output.layer_light || output.layer_order || output.layer_error;
    in.brief = state.live && !layers && !path_filters(state.filter);
    return in;
}

}  // namespace

bool path_parts(const OutputSettings& output) {
    return output.layer_cloud || output.layer_light || output.layer_order;
}

PathInput path_input(const Context& context, const FrameView& view, const PathState& state) {
    PathInput in;
    in.medium = &view.world.medium;
    in.lighting = &view.lighting;
    in.majorants = state.majorants.tracking.span();
    in.block = state.majorants.block;
    in.camera = state.camera;
    in.seed = state.seed;
    in.threads = context.threads;
    in.kernels = context.kernels;
    in.rules.max_depth = state.settings.max_depth;
    in.jitter = !state.settings.centre;
    in.rules.guide = state.settings.guide;
    in.rules.sun_radius_deg = view.scene.sun.angular_radius_deg;
    if (state.importance.made) in.rules.importance = &state.importance.params;
    in.parts = path_parts(view.scene.output) || view.lighting.air ||
               (path_regresses(state.filter) && view.lighting.opaque());
    return in;
}

Status begin_film(const Context& context, const FrameView& view, PathState& state) {
    // A host may have set other lights or another camera.
    state.splits = why_no_importance(view) == nullptr;
    if (state.splits)
        PILEUS_TRY(make_importance(context, view, state.majorants, state.importance));
    else
        state.importance.made = false;
    const PathInput in = film_input(context, view, state);
    state.tally = tally_of(state);
    state.film.tally = PathTally{};
    PILEUS_TRY(make_film(in, state.film));
    if (!context.part.given) PILEUS_TRY(make_alpha(context, view, state));
    state.begun = true;
    return state.scratch.ready ? Status::ok() : prepare_path(in, state.scratch);
}

Status trace_film(const Context& context, const FrameView& view, std::uint64_t samples,
                  PathState& state) {
    PathInput in = film_input(context, view, state);
    if (context.sharing != nullptr)
        in.part = context.sharing->part();
    else
        in.ended = patient_stop(context);
    return trace_paths(in, samples, state.scratch, state.film);
}

PathTally tally_of(const PathState& state) {
    PathTally all = state.tally;
    add_tally(state.film.tally, all);
    return all;
}

}  // namespace pileus
