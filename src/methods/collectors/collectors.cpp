// SPDX-License-Identifier: Apache-2.0
// See collectors.h. Preparation, photons and the plan; collectors_show.cpp makes the picture.
#include "src/methods/collectors/collectors.h"

#include "src/methods/collectors/billboards/gl_billboards.h"

namespace pileus {
namespace {

/// Batches for the standard error: the largest divisor of the generations up to 16, so that all
/// hold equally many; if that is under 8, as many as fit with slightly unequal shares.
std::uint64_t batch_count(std::uint64_t generations) {
    std::uint64_t best = 1;
    for (std::uint64_t n = 1; n <= kMostBatches && n <= generations; ++n)
        if (generations % n == 0) best = n;
    const std::uint64_t most = generations < kMostBatches ? generations : kMostBatches;
    return best >= 8 ? best : most;
}

bool wants_error(const Scene& scene) { return scene.output.layer_error; }

/// Where deposits of the phase function look: the camera, or back along its parallel rays.
void aim_deposit(const Scene& scene, CollectorsRun& run) {
    const CameraParams camera = make_camera(scene.camera, 0, run.world->medium.low_m);
    run.deposit.orthographic = scene.camera.orthographic;
    for (int a = 0; a < 3; ++a)
        run.deposit.camera[a] = scene.camera.orthographic ? -camera.forward[a] : camera.origin[a];
}

/// The sun that the lights are planned for: one that only rises during an animation needs its
/// place among them from the start.
double first_elevation(const Scene& scene) {
    const Animation& a = scene.animation;
    const double own = scene.sun.elevation_deg;
    if (!scene.ground.present || own > 0 || !a.present || !a.moves_sun) return own;
    return a.sun_elevation_deg[0] > a.sun_elevation_deg[1] ? a.sun_elevation_deg[0]
                                                           : a.sun_elevation_deg[1];
}

/// Why a collision stores nothing about the sun's axis; null where it does.
const char* why_no_axis(const CollectorSettings& c, const CollectorsRun& run) {
    if (run.camera_cells > 0) return "closure \"camera\" has all bands";
    if (c.paper) return "variant \"paper\"";
    if (c.lobe_closure) return "closure \"lobe\"";
    if (!run.lighting.sunlit) return "no sun";
    if (shows_harmonics(run)) return "nodes of a periodic medium hold bands alone";
    if (c.window) return "the window damps the higher bands";
    if (c.axis_degrees == 0) return "switched off";
    return nullptr;
}

/// Degrees beyond the bands that a phase function still sends on, as far as they were asked for.
int axis_degrees(const CollectorSettings& c, const CollectorsRun& run) {
    constexpr float kNothing = 1e-3f;  // of a moment
    if (why_no_axis(c, run) != nullptr) return 0;
    // Moments of tables end at a degree of their own.
    const int most = kPhaseMoments - c.bands;
    for (int n = c.axis_degrees < most ? c.axis_degrees : most; n > 0; --n)
        for (int i = 0; i < run.world->medium.count; ++i) {
            const float chi =
                phase_moment(run.world->medium.optics[std::size_t(i)].phase, c.bands + n - 1);
            if (chi > kNothing || chi < -kNothing) return n;
        }
    return 0;
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
Status plan_deposit(const Scene& scene, CollectorsRun& run) {
    const CollectorSettings& c = scene.collectors;
    DepositPlan& d = run.deposit;
    d.bands = c.lobe_closure ? 2 : c.bands;
    d.mode = c.paper ? kDepositOutgoing : kDepositIncident;
    if (run.camera_cells > 0) d.mode = kDepositCamera;
    const bool split = (c.first_order_split || run.camera_cells > 0) && run.lighting.sunlit;
    d.first_order = !split ? 0 : (is_marched(run) ? 2 : 1);
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
    if (d.places < 0)
        return Status::limit(scene.file +
                             ": collectors.photons: " + std::to_string(scene.collectors.photons) +
                             " photons could overflow the 64-bit sums; take fewer");
    run.plan.bounds = {
        deposit_bound("light in a collector", most_deposits(run), largest, d.places)};
    return Status::ok();
}

/// Empty sums; what was shot before is forgotten.
Status allocate_photons(const Context& context, CollectorsRun& run) {
    ++run.layouts;
    run.ring_first = run.next_generation;
    const TraceInput in = collectors_trace_input(context, run);
    PILEUS_TRY(prepare_trace(in, run.scratch));
    run.photons.tallies.assign(run.lighting.lights.size(), TraceTally{});
    run.photons.slots.clear();
    run.photons.slots.resize(std::size_t(collectors_slots(run)));
    const auto sums = arrays::photon_slot(slot_size(in), run.lighting.lights.size());
    for (PhotonSlot& slot : run.photons.slots) PILEUS_TRY(allocate(sums, slot.sums));
    return Status::ok();
}

void note_plan(const Scene& scene, CollectorsRun& run) {
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
    note_solids(run.world->solids, run.around.depth, plan);
    if (!run.lighting.opaque()) plan.leave_out("depth test", "nothing solid: no ground");
    if (!scene.output.layer_depth) plan.leave_out("depth of the medium", "no depth layer");
    if (!scene.output.layer_error) plan.leave_out("batches and second moments", "no error layer");
    if (!scene.collectors.billboards) plan.leave_out("billboards", "display = \"march\"");
    for (const std::string& what : run.world->media_plan.needed) plan.needed.push_back(what);
    for (const LeftOut& l : run.world->media_plan.left_out) plan.left_out.push_back(l);
}

/// Aims the sky map at the medium's box. A coloured one asks for a set of sums per colour channel,
/// as its photons differ in colour.
Status aim_map(CollectorsRun& run) {
    if (!run.around.sky_map.present()) return Status::ok();
    PILEUS_TRY(aim_sky_map(run.world->medium.extent_m, run.world->medium.grid.periodic,
                           run.around.sky_map));
    if (run.around.sky_map.view.planes == 3 && run.deposit.channels == 1) {
        run.deposit.channels = 3;
        run.plan.need("coefficients per colour channel: coloured sky map");
    }
    return Status::ok();
}

/// Coloured solids tell the channels of a photon apart as well.
void tell_colours(CollectorsRun& run) {
    if (!run.world->solids.coloured() || run.deposit.channels == 3) return;
    run.deposit.channels = 3;
    run.plan.need("coefficients per colour channel: coloured solids");
}

/// Lights, photons and what a collision stores, for the medium as it is known now.
Status choose_light(CollectorsRun& run) {
    const Scene& scene = *run.scene;
    const std::int64_t photons = run.budget_photons;
    run.plan = Plan{};
    run.deposit.channels = run.world->medium.channels;
    run.plan.bias = collectors_bias(scene.collectors);
    PILEUS_TRY(aim_map(run));
    tell_colours(run);
    aim_deposit(scene, run);
    run.generations = std::uint64_t(scene.collectors.generations);
    if (photons >= 0 && std::uint64_t(photons) < run.generations)
        run.generations = photons > 0 ? std::uint64_t(photons) : 1;
    run.sun_elevation_deg = first_elevation(scene);
    run.lighting = light_world(scene, run.sun_elevation_deg, *run.world, run.around, run.plan);
    share_photons(std::uint64_t(photons) / run.generations, run.lighting.lights);
    run.light_photons.clear();
    for (const Light& l : run.lighting.lights) run.light_photons.push_back(l.photons);
    run.ground_map = make_ground_map(run.world->medium, run.lighting);
    return plan_deposit(scene, run);
}

}  // namespace

TraceInput collectors_trace_input(const Context& context, const CollectorsRun& run) {
    TraceInput in;
    in.medium = &run.world->medium;
    in.lighting = &run.lighting;
    in.majorants = run.majorants.tracking.span();
    in.block = run.majorants.block;
    in.collector_of_voxel = run.prepared.collector_of_voxel.span();
    in.collectors = run.prepared.collectors.size();
    in.deposit = run.deposit;
    in.seed = std::uint64_t(run.scene->seed);
    in.threads = context.threads;
    in.kernels = context.kernels;
    in.max_events = run.max_events;
    in.ground = run.ground_map;
    in.shared_sums = run.plan.accumulation.shared;
    return in;
}

std::uint64_t collectors_slots(const CollectorsRun& run) {
    if (run.scene->animation.present && run.scene->animation.frames > 1) return run.generations;
    return wants_error(*run.scene) ? batch_count(run.generations) : 1;
}

Status collectors_weigh(const Context& context, CollectorsRun& run) {
    PILEUS_TRY(choose_light(run));
    note_plan(*run.scene, run);
    return collectors_measure(context, run);
}

Status collectors_outline(const Context& context, CollectorsRun& run) {
    const Scene& scene = *run.scene;
    run.budget_photons = collectors_photons(scene, run.budget);
    if (scene.collectors.camera_closure) {
        if (scene.animation.present && scene.animation.moves_camera)
            return Status::bad_input(scene.file +
                                     ": collectors.closure: \"camera\" needs a fixed "
                                     "camera, but animation.camera_orbit_deg moves it");
        run.camera_cells = scene.collectors.cell_voxels;
    }
    // Tell before any work that the compositor asked for is not here.
    if (scene.collectors.compositor != Compositor::kBuiltin) {
        GlBlender blender;
        PILEUS_TRY(open_gl_blender(scene.collectors.compositor, blender));
    }
    return collectors_weigh(context, run);
}

Status collectors_prepare(const Context& context, CollectorsRun& run) {
    const Scene& scene = *run.scene;
    // The values may show that there is no medium, or more of it than sizes tell.
    PILEUS_TRY(collectors_weigh(context, run));
    PILEUS_TRY(run.camera_cells > 0
                   ? prepare_cells(run.world->medium, run.camera_cells, context, run.prepared)
                   : prepare_collectors(run.world->medium, scene.collectors, scene.seed, context,
                                        run.prepared));
    PILEUS_TRY(make_photon_majorants(run.world->medium, scene.collectors.local_tracking, context,
                                     run.majorants));
    run.outlined_only = false;
    PILEUS_TRY(collectors_measure(context, run));
    PILEUS_TRY(allocate_photons(context, run));
    collectors_digest_prepared(run);
    return Status::ok();
}

void collectors_end_tracing(CollectorsRun& run) {
    run.scratch.sums = Buffer<std::int64_t>();
    run.prepared.collector_of_voxel = Buffer<std::int32_t>();
    run.majorants.tracking = Buffer<float>();
}

namespace {

/// The set of lights is the ring's layout: a light that has set keeps its place and shoots no
/// photons; those of its day stay in the ring until they leave it.
void keep_places(const CollectorsRun& run, Lighting& next) {
    std::vector<Light> lights = run.lighting.lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        bool found = false;
        for (const Light& n : next.lights)
            if (n.stream == lights[i].stream) lights[i] = n, found = true;
        lights[i].photons = found ? run.light_photons[i] : 0;
        // A diffuse light's colour is today's for the whole ring; a beam's never changes.
        if (!found && !lights[i].beam) lights[i].colour = {0, 0, 0};
    }
    next.lights = lights;
}

/// Whether every light of `next` has a place in the ring, and the ground its map.
bool has_places(const CollectorsRun& run, const Lighting& next) {
    for (const Light& light : next.lights) {
        bool found = false;
        for (const Light& place : run.lighting.lights) found |= place.stream == light.stream;
        if (!found) return false;
    }
    const GroundMap map = make_ground_map(run.world->medium, next), &own = run.ground_map;
    bool same = map.cells == own.cells;
    for (int a = 0; a < 2; ++a)
        same &= map.origin[a] == own.origin[a] && map.per_metre[a] == own.per_metre[a];
    return same;
}

}  // namespace

Status collectors_set_sun(double elevation_deg, const Context&, CollectorsRun& run) {
    if (elevation_deg == run.sun_elevation_deg) return Status::ok();
    Plan ignored;
    Lighting next = light_world(*run.scene, elevation_deg, *run.world, run.around, ignored);
    keep_places(run, next);
    run.lighting = next;
    run.sun_elevation_deg = elevation_deg;
    run.shadow_ready = false;
    return Status::ok();
}

Status collectors_relight(bool anew, const Context& context, CollectorsRun& run) {
    Plan ignored;
    const double elevation_deg = run.scene->sun.elevation_deg;
    Lighting next;
    if (!anew) next = light_world(*run.scene, elevation_deg, *run.world, run.around, ignored);
    if (anew || !has_places(run, next)) {
        PILEUS_TRY(collectors_weigh(context, run));
        run.shadow_ready = false;
        return allocate_photons(context, run);
    }
    keep_places(run, next);
    const Lighting& before = run.lighting;
    if (next.sunlit != before.sunlit || next.to_sun != before.to_sun) run.shadow_ready = false;
    run.lighting = next;
    run.sun_elevation_deg = elevation_deg;
    return Status::ok();
}

Status collectors_shoot(const Context& context, CollectorsRun& run) {
    TraceInput in = collectors_trace_input(context, run);
    in.ended = patient_stop(context);
    PhotonSlot& slot =
        run.photons
            .slots[std::size_t((run.next_generation - run.ring_first) % run.photons.slots.size())];
    // In an animation each generation has a slot of its own: the oldest gives way, exactly.
    const bool ring = run.photons.slots.size() == run.generations && run.scene->animation.present;
    if (ring && slot.generations > 0) {
        std::memset(slot.sums.data(), 0, std::size_t(slot.sums.bytes()));
        slot.generations = 0;
        slot.scatterings = 0;
    }
    slot.flux_per_photon_m2.clear();
    for (const Light& l : run.lighting.lights) {
        slot.flux_per_photon_m2.push_back(l.photons > 0 ? l.power_m2 / double(l.photons) : 0);
        if (l.beam) slot.sun_travel = l.travel;
    }
    const std::uint64_t before = slot.generations;
    PILEUS_TRY(trace_generation(in, run.next_generation, run.scratch, slot, run.photons.tallies));
    run.interrupted = slot.generations == before;
    if (!run.interrupted) ++run.next_generation;
    return Status::ok();
}

}  // namespace pileus
