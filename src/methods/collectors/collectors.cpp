// SPDX-License-Identifier: Apache-2.0
// See collectors.h. Preparation, photons and the plan; collectors_show.cpp makes the picture.
#include "src/methods/collectors/collectors.h"

#include "kernels_cpu/core/profile.h"
#include "src/methods/collectors/billboards/gl_billboards.h"
#include "src/photons/lit_march.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

/// Why a collision stores nothing about the sun's axis; null where it does.
const char* why_no_axis(const CollectorSettings& c, const CollectorsRun& run) {
    if (run.camera_cells > 0) return "closure \"camera\" has all bands";
    if (c.paper) return "variant \"paper\"";
    if (c.lobe_closure) return "closure \"lobe\"";
    if (!run.lighting.sunlit) return "no sun";
    if (run.world->medium.grid.periodic && shows_harmonics(run))
        return "nodes of a periodic medium hold bands alone";
    if (c.window) return "the window damps the higher bands";
    if (c.axis_degrees == 0) return "switched off";
    return nullptr;
}

int axis_degrees(const CollectorSettings& c, const CollectorsRun& run) {
    if (why_no_axis(c, run) != nullptr) return 0;
    return useful_axis_degrees(run.world->medium, c.bands, c.axis_degrees);
}

/// First-order coefficients are 1; P_l exceeds 1 by its rounding alone; |y| stays below 1.1 for 8
/// bands; else the phase function's peak.
double largest_deposit(const CollectorsRun& run) {
    const double peak = double(phase_peak(run.world->medium));
    if (run.deposit.mode == kDepositCamera && peak > 1) return peak;
    return run.deposit.bands > 6 ? 1.1 : run.deposit.axis_degrees > 0 ? 1.01 : 1;
}

/// Every photon of the ring may end only with its last event.
double most_deposits(const CollectorsRun& run) {
    double photons = 0;
    for (const Light& l : run.lighting.lights) photons += double(l.photons);
    return photons * double(run.generations) * double(run.max_events);
}

/// Decides what a collision stores, and proves that the sums hold it.
Status plan_deposit(CollectorsRun& run) {
    const CollectorSettings& c = run.settings;
    DepositPlan& d = run.deposit;
    d.bands = c.lobe_closure ? 2 : c.bands;
    d.mode = c.paper ? kDepositOutgoing : kDepositIncident;
    if (run.camera_cells > 0) d.mode = kDepositCamera;
    PILEUS_TRY(check_camera_closure("collectors.closure", run));
    const bool split = (c.first_order_split || run.camera_cells > 0) && run.lighting.sunlit;
    d.first_order = !split ? 0 : (is_marched(run) ? 2 : 1);
    choose_peak(c.peak_deg, run);
    d.axis_degrees = axis_degrees(c, run);
    if (d.axis_degrees == 0) {
        const char* why = why_no_axis(c, run);
        run.plan.leave_out("degrees about the sun's axis",
                           why != nullptr ? why : "no phase function has moments there");
    }
    d.coefficients = d.mode == kDepositCamera
                         ? 1
                         : d.bands * d.bands + d.axis_degrees + (d.first_order == 1 ? 1 : 0);
    if (!split)
        run.plan.leave_out("first-order split", run.lighting.sunlit ? "switched off" : "no sun");

    const double largest = largest_deposit(run);
    d.places = fixed_point_places(most_deposits(run), largest);
    if (d.places < 0) return sums_overflow("collectors.photons", run);
    run.plan.bounds = {
        deposit_bound("light in a collector", most_deposits(run), largest, d.places)};
    return Status::ok();
}

void note_plan(const Scene& scene, CollectorsRun& run) {
    if (!kPlans) return;
    Plan& plan = run.plan;
    plan.need("samples");
    plan.need("tree");
    plan.need("collectors");
    plan.need("majorants");
    for (const Light& l : run.lighting.lights) plan.need(("photons from the " + l.name).c_str());
    plan.need(is_marched(run) ? "marched display" : "billboards");
    if (run.deposit.channels == 1)
        plan.leave_out("coefficients per colour channel", "achromatic medium: one set per light");
    if (is_white(run.world->medium)) plan.leave_out("absorption", "albedo 1");
    note_solids(run.world->solids, run.environment.depth, plan);
    note_upsampling(scene, run.thin, plan);
    if (!run.lighting.opaque()) plan.leave_out("depth test", "nothing solid: no ground");
    if (!scene.wants_depth()) plan.leave_out("depth of the medium", "no depth layer");
    if (!scene.output.layer_error) plan.leave_out("batches and second moments", "no error layer");
    if (!run.settings.billboards) plan.leave_out("billboards", "display = \"march\"");
    for (const std::string& what : run.world->media_plan.needed) plan.needed.push_back(what);
    for (const LeftOut& l : run.world->media_plan.left_out) plan.left_out.push_back(l);
}

/// Lights, photons and what a collision stores, for the medium as it is known now.
Status choose_light(CollectorsRun& run) {
    PILEUS_TRY(choose_photon_lights(std::uint64_t(run.settings.generations), run));
    if (kPlans) run.plan.bias = collectors_bias(run.settings);
    aim_deposit(run);
    return plan_deposit(run);
}

}  // namespace

TraceInput collectors_trace_input(const Context& context, const CollectorsRun& run) {
    TraceInput in = photon_trace_input(context, run);
    in.collector_of_voxel = run.prepared.collector_of_voxel.span();
    in.collectors = run.prepared.collectors.size();
    return in;
}

Status collectors_weigh(const Context& context, CollectorsRun& run) {
    PILEUS_TRY(choose_light(run));
    note_plan(*run.scene, run);
    return collectors_measure(context, run);
}

Status collectors_outline(const Context& context, CollectorsRun& run) {
    const Scene& scene = *run.scene;
    run.settings = scene.collectors;
    run.thin = run.settings.thin;
    run.thins = !run.settings.billboards;
    if (kDevices)
        PILEUS_TRY(
            check_host_lights(context, scene.lights, scene.atmosphere.present, run.world->medium));
    if (kChecks) PILEUS_TRY(check_thinned(context, scene, "collectors", run.settings.thin));
    run.light_refresh = run.settings.light_refresh;
    if (run.light_refresh > 1 && kDevices && context.kernels->device != nullptr)
        return Status::bad_input(scene.file +
                                 ": collectors.light_refresh: for the host alone, allowed: 1");
    if (kChecks && run.settings.thin.every() > 1 && !is_marched(run))
        return Status::bad_input(scene.file +
                                 ": collectors.display: \"billboards\" has no marched pixels, "
                                 "allowed: march, or collectors.scale = 1 and temporal = 0");
    run.budget_photons = run.budget.photons >= 0 ? run.budget.photons : run.settings.photons;
    if (run.settings.camera_closure) {
        const char* const mover = kFilms ? mover_of_view(scene) : nullptr;
        if (kFilms && mover != nullptr)
            return Status::bad_input(scene.file +
                                     ": collectors.closure: \"camera\" needs a fixed "
                                     "camera, but " +
                                     mover + " moves it");
        run.camera_cells = run.settings.cell_voxels;
        run.fixed_view =
            "collectors.closure \"camera\" lights cells towards a fixed one, allowed: another "
            "closure";
    }
    // Tell before any work that the compositor asked for is not here.
    if (kChecks && run.settings.compositor != Compositor::kBuiltin) {
        GlBlender blender;
        PILEUS_TRY(open_gl_blender(run.settings.compositor, blender));
    }
    return collectors_weigh(context, run);
}

Status collectors_prepare(const Context& context, CollectorsRun& run) {
    const Scene& scene = *run.scene;
    // The values may show that there is no medium, or more of it than sizes tell.
    PILEUS_TRY(collectors_weigh(context, run));
    PILEUS_TRY(run.camera_cells > 0
                   ? prepare_cells(run.world->medium, run.camera_cells, context, run.prepared)
                   : prepare_collectors(run.world->medium, run.settings, scene.seed, context,
                                        run.prepared));
    PILEUS_TRY(make_photon_majorants(run.world->medium, run.settings.local_tracking, context,
                                     run.majorants));
    run.outlined_only = false;
    PILEUS_TRY(collectors_measure(context, run));
    PILEUS_TRY(lay_out_photons(collectors_trace_input(context, run), run));
    if (kPlans && context.digests) collectors_digest_prepared(run);
    return Status::ok();
}

void collectors_end_tracing(CollectorsRun& run) {
    run.scratch.sums = Buffer<std::int64_t>();
    run.prepared.collector_of_voxel = Buffer<std::int32_t>();
    run.majorants.tracking = Buffer<float>();
}

Status collectors_relight(bool anew, const Context& context, CollectorsRun& run) {
    if (!anew && relight_photons(run)) return Status::ok();
    if (run.sealed) return refuse_new_lights();
    run.upsample.ready = false;
    PILEUS_TRY(collectors_weigh(context, run));
    forget_sun_shadow(run);
    return lay_out_photons(collectors_trace_input(context, run), run);
}

Status collectors_shoot(const Context& context, CollectorsRun& run) {
    return shoot_generation(collectors_trace_input(context, run), context, run);
}

}  // namespace pileus
