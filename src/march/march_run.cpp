// SPDX-License-Identifier: Apache-2.0
// See march_run.h. Preparation and sessions; march_show.cpp makes the picture.
// in: settings of the march -> out: a prepared run.
// docs/raymarch.md
#include "kernels_cpu/core/profile.h"
#include "src/march/march_parts.h"
#include "src/methods/check_support.h"
#include "src/plan/report.h"
#include "src/world/medium/resample.h"

namespace pileus {
namespace {

RaymarchRun& own(MethodRun& run) { return static_cast<RaymarchRun&>(run); }

void choose_light(const SunPlace& sun, RaymarchRun& run) {
    run.lighting = light_of(*run.scene, sun, *run.world, run.environment);
}

/// The medium with no extinction above the largest one asked for.
Status cap_medium(RaymarchRun& run) {
    const Medium& medium = run.world->medium;
    if (!caps_extinction(run)) return Status::ok();
    const float most = float(run.simple->max_extinction_per_m / double(medium.sigma));
    Medium& out = run.capped;
    out.low_m = medium.low_m;
    for (std::size_t a = 0; a < 3; ++a) out.extent_m[a] = medium.extent_m[a];
    out.grid = medium.grid;
    out.volume.size = medium.volume.size;
    out.sigma = medium.sigma;
    out.channels = medium.channels;
    out.optics = medium.optics;
    out.density_max = most;
    out.detail.view = medium.detail.view;
    out.detail.step_m = medium.detail.step_m;
    PILEUS_TRY(allocate(arrays::capped_density(medium.grid), out.volume.density));
    const Span<const float> from = medium.volume.density.span();
    const Span<float> to = out.volume.density.span();
    for (std::size_t i = 0; i < from.size; ++i) to[i] = from[i] < most ? from[i] : most;
    return Status::ok();
}

/// Cells of the buffer; axes that the scene leaves alone have the medium's.
std::array<int, 3> sun_cells(const RaymarchRun& run) {
    std::array<int, 3> cells = run.world->medium.volume.size;
    for (std::size_t a = 0; a < 3; ++a)
        if (run.simple->resolution[a] > 0) cells[a] = run.simple->resolution[a];
    return cells;
}

/// Nodes of sunlight and sky are made again by the next picture where their light has changed.
Status aim(int, bool anew, const Context&, MethodRun& method_run) {
    RaymarchRun& run = own(method_run);
    const Lighting before = run.lighting;
    choose_light(place_of(run.scene->sun), run);
    const Lighting& now = run.lighting;
    const auto& size = run.scene->camera.resolution;
    if (anew || !same_shine(before, now)) {
        run.sky_made = false;
        run.upsample.ready = false;
    }
    if (run.camera.width != size[0] || run.camera.height != size[1] ||
        before.opaque() != now.opaque())
        forget_pictures(run.upsample);
    return Status::ok();
}

Status advance(std::uint64_t, const Context&, MethodRun&, std::uint64_t& done) {
    done = 0;
    return Status::ok();
}

LightUnits units(const MethodRun&) { return {}; }

Status compose(const FrameStep& step, const Context& context, MethodRun& method_run,
               Planes*& planes) {
    RaymarchRun& run = own(method_run);
    planes = &run.planes;
    ++run.turn;
    return march_frame(step, context, run);
}

FrameWork full_work(const MethodRun& method_run) {
    const RaymarchRun& run = static_cast<const RaymarchRun&>(method_run);
    FrameWork out;
    if (run.simple == nullptr) {
        out = work_of(run.settings.thin);
        out.light_refresh = run.settings.light_refresh;
        out.steps = run.settings.steps;
    } else {
        out.steps = run.budget.steps >= 0 ? int(run.budget.steps) : run.simple->steps;
    }
    return out;
}

void put_tables(const FrameWork& work, const MethodRun& method_run, MethodTables& tables) {
    if (static_cast<const RaymarchRun&>(method_run).simple != nullptr) {
        tables.optical_depth.steps = work.steps;
        return;
    }
    put_work(work, tables.raymarch.thin);
    tables.raymarch.steps = work.steps;
    tables.raymarch.light_refresh = work.light_refresh;
}

Status set_limits(const FrameWork& work, MethodRun& method_run) {
    RaymarchRun& run = own(method_run);
    if (run.simple != nullptr) {
        if (work.steps == 0) return Status::ok();
        run.settings.spacing = RaymarchSpacing::kUniform;
    } else {
        put_work(work, run.settings.thin);
        run.settings.light_refresh = work.light_refresh;
        run.whole_thin = run.settings.thin;
    }
    run.settings.steps = work.steps;
    return Status::ok();
}

}  // namespace

Status check_marched(const Scene& scene, const Budget& budget) {
    PILEUS_TRY(check_budget_kinds(scene, budget));
    if (scene.camera.flux)
        return Status::bad_input(scene.file +
                                 ": camera.projection: \"flux\" sees along no single ray, which "
                                 "method " +
                                 scene.method + " marches, allowed: perspective, orthographic");
    PILEUS_TRY(check_layer_kinds(scene));
    return kFilms ? check_march_parts(scene) : Status::ok();
}

bool caps_extinction(const RaymarchRun& run) {
    const double most = run.simple != nullptr ? run.simple->max_extinction_per_m : 0;
    if (!(most > 0) || run.outlined_only) return most > 0;
    const Medium& medium = run.world->medium;
    return most < double(medium.sigma) * double(medium.density_max);
}

bool has_sun_grid(const RaymarchRun& run) {
    // A sun that is below the horizon may rise.
    if (run.simple == nullptr || !run.scene->sun.present) return false;
    return run.simple->light_scale != 1 || sun_cells(run) != run.world->medium.volume.size;
}

const Medium& marched_medium(const RaymarchRun& run) {
    return run.capped.volume.density.empty() ? run.world->medium : run.capped;
}

Grid sun_grid(const RaymarchRun& run) {
    return has_sun_grid(run) ? resampled_grid(run.world->medium, sun_cells(run))
                             : run.world->medium.grid;
}

Status make_lit_medium(const Context& context, RaymarchRun& run) {
    if (!has_sun_grid(run) || !run.lit.volume.density.empty()) return Status::ok();
    const StageClock clock(context, "buffer cells");
    // Whole or not at all: what memory ended within is made anew.
    Medium lit;
    PILEUS_TRY(resample_medium(marched_medium(run), sun_cells(run), context.threads,
                               arrays::lit_density(sun_grid(run)), lit));
    lit.sigma *= float(run.simple->light_scale);
    PILEUS_TRY(make_majorants(lit, false, context, run.lit_majorants));
    run.lit = std::move(lit);
    return Status::ok();
}

Status march_outline(const Context& context, RaymarchRun& run) {
    if (kDevices && context.kernels->device != nullptr)
        return Status::bad_input(std::string("--isa: \"") + context.kernels->name + "\": method " +
                                 run.scene->method +
                                 " runs on the host alone, allowed: another, or another method");
    run.whole_steps = run.settings.steps;
    run.whole_thin = run.settings.thin;
    choose_light(run.sun_of(0), run);
    return march_measure(context, run);
}

Status march_prepare(const Context& context, MethodRun& method_run) {
    RaymarchRun& run = own(method_run);
    // The values may show that there is no medium.
    choose_light(run.sun_of(0), run);
    PILEUS_TRY(make_majorants(run.world->medium, false, context, run.majorants));
    run.outlined_only = false;
    PILEUS_TRY(cap_medium(run));
    PILEUS_TRY(make_density_levels(marched_medium(run), run.levels, run.majorants.skip_block,
                                   context, run.coarse));
    PILEUS_TRY(march_measure(context, run));
    if (kPlans && context.digests) run.digests = {{"density", density_digest(*run.world)}};
    return Status::ok();
}

Status RaymarchRun::reserve(LateRows&) {
    const auto& size = scene->camera.resolution;
    const bool solid = lighting.opaque() || environment.depth.present;
    PILEUS_TRY(reserve_depths(size, solid, planes));
    PILEUS_TRY(reserve_lamp_nodes(world->medium, scene->lights.size(), lamps));
    slices.reserve();
    ground_shadow.slices.reserve();
    if (simple != nullptr) return Status::ok();
    // Fewer marched pixels have fewer nodes.
    if (sky_nodes) PILEUS_TRY(reserve_sky_light(world->layer.params, kMostSkyLightBits, sky_light));
    return reserve_upsampling(settings.thin, size, solid, upsample);
}

void march_budget_used(int, const MethodRun& method_run, const Report& report, Budget& used) {
    const RaymarchRun& run = static_cast<const RaymarchRun&>(method_run);
    const bool by_cells = run.simple != nullptr && run.simple->steps == 0;
    const bool chosen = !report.light_rule.empty();
    if (chosen && (used.steps >= 0 || !by_cells)) used.steps = report.frame_work.steps;
}

const LiveMethod live_march{aim,
                            advance,
                            units,
                            compose,
                            full_work,
                            set_limits,
                            kept(kChecks, put_tables),
                            march_most_units};

}  // namespace pileus
