// SPDX-License-Identifier: Apache-2.0
// See trace_paths.h. Preparation; path_light.cpp traces, path_show.cpp makes the picture.
#include "src/methods/path/path.h"

#include "src/base/digest.h"
#include "src/plan/scene_limits.h"
#include "src/world/medium/mix_media.h"
#include "src/world/world.h"

namespace pileus {
namespace {

PathRun& own(MethodRun& run) { return static_cast<PathRun&>(run); }

std::unique_ptr<MethodRun> make() { return std::make_unique<PathRun>(); }

Status check(const Scene& scene, const Budget& budget) {
    constexpr const char* kAllowed = "samples=N, error=E, seconds=S";
    if (budget.photons >= 0) return unknown_budget("--budget photons", scene.method, kAllowed);
    if (budget.steps >= 0) return unknown_budget("--budget steps", scene.method, kAllowed);
    const OutputSettings& output = scene.output;
    if (scene.camera.flux &&
        (output.layer_depth || output.layer_optical_depth || output.layer_transmittance))
        return Status::bad_input(scene.file +
                                 ": output.layers: a flat detector (camera.projection \"flux\") "
                                 "sees along no single ray, allowed: radiance, alpha, error, "
                                 "cloud, light, order");
    return Status::ok();
}

/// Light for the medium as it is known now; a map lights by its own radiances.
void light_world(const Scene& scene, double sun_elevation_deg, PathRun& run) {
    Plan photons;  // speaks of photons alone
    run.lighting =
        plan_lighting(scene, run.medium, sun_elevation_deg, photons, &run.sky_map, &run.solids);
}

void digest_prepared(PathRun& run) {
    Digest density, majorants;
    density.floats(run.medium.volume.density.span());
    if (run.medium.count > 1) density.floats(run.medium.parts.span());
    majorants.floats(run.majorants.tracking.span());
    run.digests = {{"density", density.hex()}, {"majorants", majorants.hex()}};
}

Status outline(const Scene& scene, const Budget& budget, const Context& context,
               MethodRun& method_run) {
    PathRun& run = own(method_run);
    run.scene = &scene;
    run.budget = budget;
    PILEUS_TRY(check_scene_limits(scene, context.limits));
    PILEUS_TRY(outline_solids(scene, context, run.solids));
    PILEUS_TRY(scene.media.empty()
                   ? empty_medium(scene, run.medium)
                   : outline_media(scene, context.limits, std::uint64_t(context.threads),
                                   run.media_plan, run.medium, run.source));
    PILEUS_TRY(read_sky_map(scene, context, run.sky_map));
    light_world(scene, sun_at(scene, 0), run);
    run.camera = make_camera(scene.camera, 0, run.medium.low_m);
    return path_measure(context, run);
}

Status load(const Scene& scene, const Context& context, PathRun& run) {
    if (scene.media.empty()) return Status::ok();
    const StageClock clock(context, "density");
    run.media_plan = Plan{};
    PILEUS_TRY(load_media(scene, context.limits, context.threads, run.media_plan, run.medium,
                          context.kernels));
    run.source.mean_density = mean_density(run.medium);
    return Status::ok();
}

Status prepare(const Scene& scene, const Budget& budget, const Context& context,
               MethodRun& method_run) {
    PathRun& run = own(method_run);
    PILEUS_TRY(outline(scene, budget, context, run));
    PILEUS_TRY(load(scene, context, run));
    PILEUS_TRY(load_solids(scene, run.medium.low_m, context, run.solids));
    // The values may show that there is no medium, or more of it than sizes tell.
    light_world(scene, sun_at(scene, 0), run);
    run.camera = make_camera(scene.camera, 0, run.medium.low_m);
    PILEUS_TRY(path_measure(context, run));
    PILEUS_TRY(make_majorants(run.medium, true, context, run.majorants, kPathCosts));
    run.outlined_only = false;
    PILEUS_TRY(path_measure(context, run));
    digest_prepared(run);
    return Status::ok();
}

Status light(const FrameStep& step, const Context& context, MethodRun& method_run) {
    PathRun& run = own(method_run);
    const Scene& scene = *run.scene;
    light_world(scene, sun_at(scene, step.frame), run);
    run.camera = make_camera(scene.camera, orbit_at(scene, step.frame), run.medium.low_m);
    // Frame f of an animation has the noise of the seed f further on.
    run.seed = std::uint64_t(scene.seed) + std::uint64_t(step.frame);
    return path_light(step, context, run);
}

}  // namespace

bool path_parts(const OutputSettings& output) {
    return output.layer_cloud || output.layer_light || output.layer_order;
}

PathInput path_input(const Context& context, const PathRun& run) {
    PathInput in;
    in.medium = &run.medium;
    in.lighting = &run.lighting;
    in.majorants = run.majorants.tracking.span();
    in.block = run.majorants.block;
    in.camera = run.camera;
    in.seed = run.seed;
    in.threads = context.threads;
    in.kernels = context.kernels;
    in.max_depth = run.scene->path.max_depth;
    in.jitter = !run.scene->path.centre;
    in.parts = path_parts(run.scene->output);
    return in;
}

const Method& path_method() {
    static constexpr Method method{"path",           make,  check,     outline,    prepare,
                                   path_report_plan, light, path_show, path_report};
    return method;
}

}  // namespace pileus
