// SPDX-License-Identifier: Apache-2.0
// The picture of lit collectors: reconstruct, display, parts.
// in: CollectorsState after shooting, a camera -> out: Planes.
// docs/methods.md 3, each image frame, steps 4 and 5; repairs 3 and 4.
#include "src/methods/collectors/collectors_display.h"
#include "src/photons/lit_march.h"

namespace pileus {

ReconstructInput collectors_reconstruct_input(const Context& context, const FrameView& view,
                                              const CollectorsState& state) {
    ReconstructInput in;
    in.medium = &view.world.medium;
    in.lighting = &state.lights.lighting;
    in.photons = &state.ring.photons;
    if (sums_ring(state) && state.ring.sum.sum.generations > 0) in.whole = &state.ring.sum.sum;
    in.collectors = state.prepared.collectors.span();
    in.shares = state.prepared.shares.span();
    in.camera = view.camera;
    in.deposit = state.lights.deposit;
    in.closure = state.camera_cells > 0        ? Closure::kCamera
                 : state.settings.closure.lobe ? Closure::kLobe
                                               : Closure::kSh;
    in.window = state.settings.closure.window;
    set_axes(in);
    if (in.closure == Closure::kSh && !in.window) damp_rings(in);
    in.batches = photon_batches(state);
    in.constant = !is_marched(state);
    in.threads = context.threads;
    return in;
}

Status compose_collectors(const Context& context, const FrameView& view, const TraceInput& launches,
                          CollectorsState& state, Planes& planes) {
    {
        const StageClock clock(context, "reconstruct");
        PILEUS_TRY(sum_ring(launches, state));
    }
    const Lighting& lighting = state.lights.lighting;
    const ReconstructInput in = collectors_reconstruct_input(context, view, state);
    CollectorColours colours;
    if (!shows_harmonics(view, state)) {
        const StageClock clock(context, "reconstruct");
        PILEUS_TRY(reconstruct(in, colours));
    }
    const int channels = 3 * (1 + in.batches);
    {
        const StageClock clock(context, "background");
        PILEUS_TRY(allocate_planes(view.camera.width, view.camera.height, channels,
                                   lighting.opaque(), view.wants_depth(), planes));
    }
    PILEUS_TRY(fill_lit_background(context, view, state, in, 0, planes));
    planes.clamped = colours.clamped_negative;
    PILEUS_TRY(collectors_display(context, view, state, in, colours, channels, planes));
    if (is_marched(state)) cut_below_zero(context, planes);
    PILEUS_TRY(add_ground_noise(context, view, state, in, planes));
    PILEUS_TRY(collectors_parts(context, view, state, in, planes));
    if (!context.digests || shows_harmonics(view, state)) return Status::ok();
    const StageClock clock(context, "layers");
    note_colours(context, colours.colour.span(), state);
    return Status::ok();
}

}  // namespace pileus
