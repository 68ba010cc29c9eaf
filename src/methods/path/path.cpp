// SPDX-License-Identifier: Apache-2.0
// See trace_paths.h. Preparation; path_light.cpp traces, path_show.cpp makes the picture.
#include "src/methods/path/path.h"

#include "kernels_cpu/core/profile.h"
#include "src/base/digest.h"
#include "src/methods/check_support.h"
#include "src/plan/report.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

PathRun& own(MethodRun& run) { return static_cast<PathRun&>(run); }

std::unique_ptr<MethodRun> make() { return std::make_unique<PathRun>(); }

Status check(const Scene& scene, const Budget& budget) {
    PILEUS_TRY(check_budget_kinds(scene, budget));
    const OutputSettings& output = scene.output;
    if (scene.camera.flux &&
        (output.layer_depth || output.layer_optical_depth || output.layer_transmittance))
        return Status::bad_input(scene.file +
                                 ": output.layers: a flat detector (camera.projection \"flux\") "
                                 "sees along no single ray, allowed: radiance, alpha, error, "
                                 "cloud, light, order");
    return check_path_filter(scene);
}

/// Light for the medium as it is known now; a map lights by its own radiances.
void choose_light(const SunPlace& sun, PathRun& run) {
    run.lighting = light_of(*run.scene, sun, *run.world, run.environment);
}

void digest_prepared(PathRun& run) {
    Digest majorants;
    majorants.floats(run.majorants.tracking.span());
    run.digests = {{"density", density_digest(*run.world)}, {"majorants", majorants.hex()}};
}

Status outline(const Context& context, MethodRun& method_run) {
    PathRun& run = own(method_run);
    run.settings = run.scene->path;
    run.filter = run.scene->filter;
    if (kDevices)
        PILEUS_TRY(check_host_lights(context, run.scene->lights, run.scene->atmosphere.present,
                                     run.world->medium));
    if (kDevices && context.kernels->device != nullptr && path_filters(run.filter))
        return Status::bad_input(std::string("--isa: \"") + context.kernels->name +
                                 "\": filter.kind = \"" + path_filter_name(run.filter) +
                                 "\" runs on the host alone, allowed: another, or none");
    choose_light(run.sun_of(0), run);
    run.camera = make_camera(run.scene->camera, 0, run.world->medium.low_m);
    return path_measure(context, run);
}

Status prepare(const Context& context, MethodRun& method_run) {
    PathRun& run = own(method_run);
    // The values may show that there is no medium, or more of it than sizes tell.
    PILEUS_TRY(outline(context, run));
    PILEUS_TRY(make_majorants(run.world->medium, true, context, run.majorants, kPathCosts));
    run.outlined_only = false;
    PILEUS_TRY(path_measure(context, run));
    if (kPlans && context.digests) digest_prepared(run);
    return Status::ok();
}

Status light(const FrameStep& step, const Context& context, MethodRun& method_run) {
    path_aim(step.frame, own(method_run));
    return path_light(step, context, method_run);
}

/// A film shows one camera and one light.
Status aim(int frame, bool anew, const Context&, MethodRun& method_run) {
    PathRun& run = own(method_run);
    choose_light(place_of(run.scene->sun), run);
    run.camera = make_camera(run.scene->camera, 0, run.world->medium.low_m);
    run.seed = std::uint64_t(run.scene->seed) + std::uint64_t(frame);
    run.begun = false;
    if (anew || run.film.width != run.camera.width || run.film.height != run.camera.height)
        run.scratch = PathScratch{};
    return Status::ok();
}

Status advance(std::uint64_t units, const Context& context, MethodRun& method_run,
               std::uint64_t& done) {
    PathRun& run = own(method_run);
    if (!run.begun) PILEUS_TRY(path_begin(context, run));
    const std::uint64_t before = run.film.samples;
    const Status status = units > 0 ? path_advance(units, context, run) : Status::ok();
    done = run.film.samples - before;
    return status;
}

LightUnits units(const MethodRun& method_run) {
    const PathRun& run = static_cast<const PathRun&>(method_run);
    const auto& size = run.scene->camera.resolution;
    LightUnits out;
    out.unit = "sample";
    out.whole = std::uint64_t(run.settings.samples_per_pixel);
    out.unit_photons = std::uint64_t(size[0]) * std::uint64_t(size[1]);
    out.held = run.begun ? run.film.samples : 0;
    return out;
}

Status most_units(const FrameWork&, const MethodRun& method_run, FrameUnits& out) {
    const auto& size = static_cast<const PathRun&>(method_run).scene->camera.resolution;
    out.pixels = out.rays = std::uint64_t(size[0]) * std::uint64_t(size[1]);
    return Status::ok();
}

/// Whole passes; a film that ran on within one has more of some pixels.
void budget_used(int, const MethodRun&, const Report& report, Budget& used) {
    used.samples = std::int64_t(report.paths.samples_per_pixel);
}

Status compose(const FrameStep&, const Context& context, MethodRun& method_run, Planes*& planes) {
    PathRun& run = own(method_run);
    if (!run.begun) PILEUS_TRY(path_begin(context, run));
    planes = &run.planes;
    return path_planes(context, run);
}

}  // namespace

void path_aim(int frame, PathRun& run) {
    const Scene& scene = *run.scene;
    choose_light(run.sun_of(frame), run);
    run.camera = make_camera(scene.camera, orbit_at(scene, frame), run.world->medium.low_m);
    // Frame f of an animation has the noise of the seed f further on.
    run.seed = std::uint64_t(scene.seed) + std::uint64_t(frame);
}

bool path_parts(const OutputSettings& output) {
    return output.layer_cloud || output.layer_light || output.layer_order;
}

PathInput path_input(const Context& context, const PathRun& run) {
    PathInput in;
    in.medium = &run.world->medium;
    in.lighting = &run.lighting;
    in.majorants = run.majorants.tracking.span();
    in.block = run.majorants.block;
    in.camera = run.camera;
    in.seed = run.seed;
    in.threads = context.threads;
    in.kernels = context.kernels;
    in.max_depth = run.settings.max_depth;
    in.jitter = !run.settings.centre;
    in.guide = run.settings.guide;
    in.sun_radius_deg = run.scene->sun.angular_radius_deg;
    in.parts = path_parts(run.scene->output) || run.lighting.air ||
               (path_regresses(run.filter) && run.lighting.opaque());
    return in;
}

const Recipe& path_method() {
    static constexpr LiveMethod live{aim,     advance, units,      compose, nullptr,
                                     nullptr, nullptr, most_units, true,    true};
    static constexpr Recipe method{"path",
                                   WorldUse::kGrid,
                                   make,
                                   kept(kChecks, check),
                                   outline,
                                   prepare,
                                   kept(kFilms, light),
                                   kept(kFilms, path_show),
                                   path_count,
                                   kept(kPlans, path_report),
                                   kept(kPlans, budget_used),
                                   &live};
    return method;
}

}  // namespace pileus
