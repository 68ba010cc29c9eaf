// SPDX-License-Identifier: Apache-2.0
// The picture of a lit collectors run: reconstruct, display, parts, layers.
// in: CollectorsRun after shooting, a camera -> out: Image.
// docs/methods.md 3, each image frame, steps 4 and 5; repairs 3 and 4.
#include "kernels_cpu/core/profile.h"
#include "src/base/digest.h"
#include "src/methods/collectors/collectors_display.h"
#include "src/photons/lit_march.h"
#include "src/picture/air_view.h"
#include "src/picture/finish_frame.h"

namespace pileus {

ReconstructInput collectors_reconstruct_input(const CameraParams& camera, const Context& context,
                                              const CollectorsRun& run) {
    ReconstructInput in;
    in.medium = &run.world->medium;
    in.lighting = &run.lighting;
    in.photons = &run.photons;
    if (sums_ring(run) && run.ring_sum.sum.generations > 0) in.whole = &run.ring_sum.sum;
    in.collectors = run.prepared.collectors.span();
    in.shares = run.prepared.shares.span();
    in.camera = camera;
    in.deposit = run.deposit;
    in.closure = run.camera_cells > 0        ? Closure::kCamera
                 : run.settings.lobe_closure ? Closure::kLobe
                                             : Closure::kSh;
    in.window = run.settings.window;
    if (in.closure == Closure::kSh && !in.window) damp_rings(in);
    in.batches = photon_batches(run);
    in.constant = !is_marched(run);
    in.threads = context.threads;
    return in;
}

Status collectors_compose(const CameraParams& camera, const Context& context, CollectorsRun& run,
                          CollectorColours& colours, Planes& planes) {
    {
        const StageClock clock(context, "reconstruct");
        PILEUS_TRY(sum_ring(collectors_trace_input(context, run), run));
    }
    const ReconstructInput in = collectors_reconstruct_input(camera, context, run);
    if (!shows_harmonics(run)) {
        const StageClock clock(context, "reconstruct");
        PILEUS_TRY(reconstruct(in, colours));
    }
    const int channels = 3 * (1 + in.batches);
    {
        const StageClock clock(context, "background");
        PILEUS_TRY(allocate_planes(camera.width, camera.height, channels, run.lighting.opaque(),
                                   run.scene->wants_depth(), planes));
    }
    PILEUS_TRY(fill_lit_background(context, run, in, 0, planes));
    planes.clamped = colours.clamped_negative;
    PILEUS_TRY(collectors_display(context, run, in, colours, channels, planes));
    if (kFilms) PILEUS_TRY(add_ground_noise(context, run, in, planes));
    if (kFilms) PILEUS_TRY(collectors_parts(context, run, in, planes));
    return show_air(context, *run.scene, run.world->medium, run.lighting, camera, run.environment,
                    planes);
}

Status collectors_show(double orbit_deg, const Context& context, CollectorsRun& run, Image& image) {
    const CameraParams camera = make_camera(run.scene->camera, orbit_deg, run.world->medium.low_m);
    CollectorColours colours;
    Planes planes;
    PILEUS_TRY(collectors_compose(camera, context, run, colours, planes));
    Report& report = *context.report;
    FinishedParts parts;
    parts.batches = true;
    PILEUS_TRY(finish_frame(context, run.scene->output, *run.world, run.environment.depth, camera,
                            parts, planes, image, report));
    if (shows_harmonics(run) || !context.digests) return Status::ok();
    const StageClock clock(context, "layers");
    Digest digest;
    digest.floats(colours.colour.span());
    report.digests.emplace_back("colours", digest.hex());
    return Status::ok();
}

}  // namespace pileus
