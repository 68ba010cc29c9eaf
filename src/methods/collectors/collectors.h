// SPDX-License-Identifier: Apache-2.0
// Method `collectors`: photons into virtual photon collectors, shown as billboards or marched.
// in: a scene and its medium -> out: images, one per call of `show`.
// Elek 2011 with the repairs of docs/methods.md 3; docs/collectors.md.
#pragma once
#include "src/methods/collectors/billboards/composite_billboards.h"
#include "src/methods/collectors/photons/reconstruct.h"
#include "src/methods/collectors/prepare/prepare.h"
#include "src/photons/photon_run.h"
#include "src/world/camera/view.h"

namespace pileus {

/// The recipe.
const Recipe& collectors_method();
extern const MethodTools collectors_tools;

/// Everything one run holds; made by `prepare`, lit by `shoot`, read by `show`.
struct CollectorsRun : PhotonRun {
    CollectorSettings settings;  ///< the scene's
    Prepared prepared;
    Buffer<float> source;  ///< light on nodes of the last picture
    int camera_cells = 0;  ///< > 0: the camera-directed estimate on cells of so many voxels
};

/// The display that a run uses: cells lit towards the camera are always marched.
inline bool is_marched(const CollectorsRun& run) {
    return !run.settings.billboards || run.camera_cells > 0;
}

/// Whether the display keeps what each collector scatters into every direction: a perspective view
/// of a periodic medium shows each from many sides, one from within a medium those around it.
inline bool shows_harmonics(const CollectorsRun& run) {
    return is_marched(run) && !run.scene->camera.orthographic &&
           (run.world->medium.grid.periodic || run.settings.directions == NodeDirections::kAll);
}

/// Whether nodes around the camera show each ray what they scatter along it, where it is so near.
inline bool shows_near(const CollectorsRun& run) {
    const CollectorSettings& c = run.settings;
    return is_marched(run) && !run.scene->camera.orthographic && !shows_harmonics(run) &&
           run.camera_cells == 0 && !c.lobe_closure && c.directions == NodeDirections::kNear;
}

/// Chooses what is needed and fills the plan from sizes alone: reads no values, prepares nothing,
/// takes no memory to speak of. kLimit: the scene or the plan is over a limit.
Status collectors_outline(const Context& context, CollectorsRun& run);

/// The same once the world is loaded; the first part of `collectors_prepare`.
Status collectors_weigh(const Context& context, CollectorsRun& run);

/// Chooses what is needed, prepares the tree and allocates the sums.
Status collectors_prepare(const Context& context, CollectorsRun& run);

/// Takes up a new sun, sky or ground of the run's scene; the ring begins anew where a light appears
/// that it has no place for, or where `anew` says so. Errors: those of the plan.
Status collectors_relight(bool anew, const Context& context, CollectorsRun& run);

/// Shoots one generation into its slot of the ring, replacing the oldest where it is full; sets
/// run.interrupted where the user ended it within.
Status collectors_shoot(const Context& context, CollectorsRun& run);

/// The picture of the lit collectors as planes; `colours` are what it is made from.
Status collectors_compose(const CameraParams& camera, const Context& context, CollectorsRun& run,
                          CollectorColours& colours, Planes& planes);

/// Reconstructs and composites one picture.
Status collectors_show(double orbit_deg, const Context& context, CollectorsRun& run, Image& image);

/// What launches of this run's photons read.
TraceInput collectors_trace_input(const Context& context, const CollectorsRun& run);

/// What the colours of this run's collectors towards a camera are made from.
ReconstructInput collectors_reconstruct_input(const CameraParams& camera, const Context& context,
                                              const CollectorsRun& run);

/// Blends the collectors as billboards of these colours, [channel][collector]; `opaque_depth` as in
/// BillboardScene, or null.
Status collectors_billboards(const Context& context, const CollectorsRun& run,
                             const CameraParams& camera, const CollectorColours& colours,
                             int channels, const float* opaque_depth, BillboardImage& out);

/// Frees what only tracing needs; part of rendering a still once its photons are shot.
void collectors_end_tracing(CollectorsRun& run);

/// Shoots what a frame needs. kCheckFailed: interrupted before there was anything to show.
Status collectors_light(const FrameStep& step, const Context& context, CollectorsRun& run);

struct CollectorsSizes;

/// The sizes of the display's grids; part of `collectors_sizes`.
void collectors_size_display(const CollectorsRun& run, const Context& context,
                             CollectorsSizes& sizes);

/// What is known of the method's bias in this scene's settings.
BiasNote collectors_bias(const CollectorSettings& settings);

/// Fills plan.memory, plan.work and plan.bounds, bounds or exact by what the run holds, and checks
/// them against the limits; part of outlining and preparing.
Status collectors_measure(const Context& context, CollectorsRun& run);

/// Of a plan that is complete but for its limits.
void collectors_note_limits(const Context& context, CollectorsRun& run);

/// Digests what no frame changes; part of `collectors_prepare`.
void collectors_digest_prepared(CollectorsRun& run);

void collectors_count(const CollectorsRun& run, Counts& counters);
/// Fills the report's energy, counts and digests from the run.
void collectors_report(const CollectorsRun& run, Report& report);

}  // namespace pileus
