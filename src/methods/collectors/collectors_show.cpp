// SPDX-License-Identifier: Apache-2.0
// The picture of a lit collectors run: reconstruct, display, parts, layers.
// in: CollectorsRun after shooting, a camera -> out: Image.
// docs/methods.md 3, each image frame, steps 4 and 5; repairs 3 and 4.
#include "kernels_cpu/core/profile.h"
#include "src/base/digest.h"
#include "src/methods/collectors/collectors_display.h"
#include "src/photons/lit_march.h"
#include "src/picture/air_view.h"

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
    in.closure = run.camera_cells > 0                 ? Closure::kCamera
                 : run.scene->collectors.lobe_closure ? Closure::kLobe
                                                      : Closure::kSh;
    in.window = run.scene->collectors.window;
    if (in.closure == Closure::kSh && !in.window) damp_rings(in);
    in.batches = photon_batches(run);
    in.constant = !is_marched(run);
    in.threads = context.threads;
    return in;
}

Status collectors_compose(const CameraParams& camera, const Context& context, CollectorsRun& run,
                          CollectorColours& colours, int& channels, Planes& planes) {
    {
        const StageClock clock(context, "reconstruct");
        PILEUS_TRY(sum_ring(collectors_trace_input(context, run), run));
    }
    const ReconstructInput in = collectors_reconstruct_input(camera, context, run);
    if (!shows_harmonics(run)) {
        const StageClock clock(context, "reconstruct");
        PILEUS_TRY(reconstruct(in, colours));
    }
    channels = 3 * (1 + in.batches);
    {
        const StageClock clock(context, "background");
        PILEUS_TRY(allocate_planes(camera.width, camera.height, channels, run.lighting.opaque(),
                                   run.scene->wants_depth(), planes));
    }
    PILEUS_TRY(fill_lit_background(context, run, in, 0, planes));
    PILEUS_TRY(collectors_display(context, run, in, colours, channels, planes));
    if (kFilms) PILEUS_TRY(add_ground_noise(context, run, in, planes));
    if (kFilms) PILEUS_TRY(collectors_parts(context, run, in, planes));
    return show_air(context, *run.scene, run.world->medium, run.lighting, camera, run.around,
                    planes);
}

Status collectors_show(double orbit_deg, const Context& context, CollectorsRun& run, Image& image) {
    const Scene& scene = *run.scene;
    const CameraParams camera = make_camera(scene.camera, orbit_deg, run.world->medium.low_m);
    CollectorColours colours;
    int channels = 3;
    Planes planes;
    PILEUS_TRY(collectors_compose(camera, context, run, colours, channels, planes));
    Report& report = *context.report;
    const StageClock clock(context, "layers");
    report.counters.clear();
    std::uint64_t clamped = colours.clamped_negative;
    PILEUS_TRY(make_layers(planes, camera.width, camera.height, channels, scene.output, image,
                           report, clamped));
    report.counters.emplace_back("clamped_negative", clamped);
    report.executed = {{"depth_tests", planes.opaque_depth.size()},
                       {"depths_stored", planes.half_depth.size()},
                       {"batches", std::uint64_t(channels / 3 - 1)},
                       {"parts_stored", run.world->medium.parts.size()}};
    report_solids(run.world->solids, run.around.depth, report);
    set_image_camera(camera, run.world->medium.low_m, image);
    planes = Planes{};  // to give memory back takes time, too
    if (shows_harmonics(run) || !context.digests) return Status::ok();
    Digest digest;
    digest.floats(colours.colour.span());
    report.digests.emplace_back("colours", digest.hex());
    return Status::ok();
}

}  // namespace pileus
