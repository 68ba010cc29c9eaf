// SPDX-License-Identifier: Apache-2.0
// See photon_grid.h. What a collision stores, preparation, photons.
// in: scene, world -> out: PhotonGridRun, lit.
// docs/photon-grid.md.
#include "src/methods/photon_grid/photon_grid.h"

#include "kernels_cpu/core/profile.h"
#include "platform/clock.h"
#include "src/photons/scatter.h"
#include "src/picture/nodes/node_grid.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

/// Why a collision stores nothing about the sun's axis; null where it does.
const char* why_no_axis(const PhotonGridSettings& s, const PhotonGridRun& run) {
    if (s.closure != GridClosure::kSh) return "closures other than \"sh\" have none";
    if (!run.lighting.sunlit) return "no sun";
    if (shows_harmonics(run)) return "cells of a periodic medium show bands alone";
    if (s.axis_degrees == 0) return "switched off";
    return nullptr;
}

/// |y| stays below 1.1 for 8 bands, P_l exceeds 1 by its rounding; else the phase function's peak.
double largest_deposit(const PhotonGridRun& run) {
    const double peak = double(phase_peak(run.world->medium));
    if (run.deposit.mode == kDepositCamera && peak > 1) return peak;
    return run.deposit.bands > 6 ? 1.1 : 1.01;
}

/// Of one generation.
double photons_of(const PhotonGridRun& run) {
    double photons = 0;
    for (const Light& l : run.lighting.lights) photons += double(l.photons);
    return photons;
}

/// Every photon may end only with its last event.
double most_deposits(const PhotonGridRun& run) { return run.most_photons * double(run.max_events); }

void choose_numbers(const PhotonGridSettings& s, PhotonGridRun& run) {
    DepositPlan& d = run.deposit;
    d.mode = kDepositIncident;
    d.bands = s.closure == GridClosure::kSh ? s.bands : 2;
    d.first_order = s.first_order_split && run.lighting.sunlit ? 2 : 0;
    d.axis_degrees = 0;
    const char* why = why_no_axis(s, run);
    if (why == nullptr) {
        d.axis_degrees = useful_axis_degrees(run.world->medium, s.bands, s.axis_degrees);
        why = "no phase function has moments there";
    }
    if (d.axis_degrees == 0) run.plan.leave_out("degrees about the sun's axis", why);
    d.coefficients = d.bands * d.bands + d.axis_degrees;
    if (s.closure == GridClosure::kPublished) d.mode = kDepositCosine, d.coefficients = 2;
    if (s.closure == GridClosure::kCamera) d.mode = kDepositCamera, d.coefficients = 1;
    choose_peak(s.peak_deg, run);
    if (d.first_order == 0)
        run.plan.leave_out("first-order split", run.lighting.sunlit ? "switched off" : "no sun");
}

/// Decides what a collision stores, and proves that the sums hold it. What a budget may add counts
/// from the start, so that it changes no bit; a high peak leaves it less room.
Status plan_deposit(PhotonGridRun& run) {
    choose_numbers(run.settings, run);
    PILEUS_TRY(check_camera_closure("photon_grid.closure", run));
    const double largest = largest_deposit(run);
    const double all = photons_of(run) * double(run.generations);
    run.most_photons = all > kLeastMostPhotons ? all : kLeastMostPhotons;
    run.deposit.places = fixed_point_places(most_deposits(run), largest);
    while (run.deposit.places < 0 && run.most_photons > all) {
        run.most_photons = run.most_photons > 2 * all ? run.most_photons / 2 : all;
        run.deposit.places = fixed_point_places(most_deposits(run), largest);
    }
    if (run.deposit.places < 0) return sums_overflow("photon_grid.photons", run);
    run.plan.bounds = {
        deposit_bound("light in a cell", most_deposits(run), largest, run.deposit.places)};
    return Status::ok();
}

void note_plan(PhotonGridRun& run) {
    if (!kPlans) return;
    const Scene& scene = *run.scene;
    Plan& plan = run.plan;
    plan.need("majorants, floored near medium");
    for (const Light& l : run.lighting.lights) plan.need(("photons from the " + l.name).c_str());
    plan.need("marched display");
    if (run.deposit.channels == 1)
        plan.leave_out("coefficients per colour channel", "achromatic medium: one set per light");
    if (is_white(run.world->medium)) plan.leave_out("absorption", "albedo 1");
    note_solids(run.world->solids, run.environment.depth, plan);
    note_upsampling(scene, run.thin, plan);
    if (!run.lighting.opaque()) plan.leave_out("depth test", "nothing solid: no ground");
    if (!scene.wants_depth()) plan.leave_out("depth of the medium", "no depth layer");
    if (!scene.output.layer_error) plan.leave_out("batches and second moments", "no error layer");
    for (const std::string& what : run.world->media_plan.needed) plan.needed.push_back(what);
    for (const LeftOut& l : run.world->media_plan.left_out) plan.left_out.push_back(l);
}

/// Cell volume over the track length that a deposit of 1 stands for.
double unit_m2(const PhotonGridRun& run) {
    const Medium& m = run.world->medium;
    double volume = 1;
    for (int a = 0; a < 3; ++a) volume *= m.extent_m[a] / run.cells.size[a];
    return volume * double(run.near.least_density) * double(m.sigma);
}

}  // namespace

std::uint64_t most_generations(const PhotonGridRun& run) {
    if (run.ring) return run.generations;
    const double photons = photons_of(run);
    const double room = photons > 0 ? run.most_photons / photons : 1;
    const std::uint64_t most = room < 1e9 ? std::uint64_t(room) : 1000000000;
    return most > run.generations ? most : run.generations;
}

std::uint64_t planned_generations(const PhotonGridRun& run) {
    if (run.budget.generations == 0 || run.ring) return run.generations;
    return wanted_generations(run, most_generations(run));
}

CellGrid photon_cells(const PhotonGridSettings& settings, std::int64_t photons,
                      const Medium& medium) {
    constexpr double kPhotonsPerCell = 32, kFewest = 4096, kMost = 0x1p19;
    CellGrid cells;
    if (settings.cells[0] > 0) {
        for (std::size_t a = 0; a < 3; ++a) cells.size[a] = settings.cells[a];
        return cells;
    }
    double wanted = double(photons) / kPhotonsPerCell;
    wanted = wanted < kFewest ? kFewest : (wanted > kMost ? kMost : wanted);
    const auto& e = medium.extent_m;
    double spacing = 0;
    for (double edge : e) spacing = edge > spacing ? edge : spacing;
    // Down from the longest edge in steps of 3 %: cubes, or a layer of them where the box is flat.
    const auto count = [&](double edge) {
        double n = 1;
        for (double length : e) n *= length > edge ? length / edge : 1;
        return n;
    };
    while (count(spacing * 0.97) <= wanted) spacing *= 0.97;
    const NodeGrid nodes = make_node_grid(medium.grid, medium.extent_m, spacing);
    for (int a = 0; a < 3; ++a) cells.size[a] = nodes.size[a];
    return cells;
}

TraceInput photon_grid_trace_input(const Context& context, const PhotonGridRun& run) {
    TraceInput in = photon_trace_input(context, run);
    in.collectors = run.cells.count();
    for (int a = 0; a < 3; ++a) in.cells.size[a] = run.cells.size[a];
    in.cells.density = run.near.least_density;
    return in;
}

GridLightInput photon_grid_light_input(const CameraParams& camera, const Context& context,
                                       const PhotonGridRun& run) {
    GridLightInput in;
    in.medium = &run.world->medium;
    in.lighting = &run.lighting;
    in.photons = &run.photons;
    if (sums_ring(run) && run.ring_sum.sum.generations > 0) in.whole = &run.ring_sum.sum;
    in.camera = camera;
    in.deposit = run.deposit;
    in.batches = photon_batches(run);
    in.threads = context.threads;
    in.cells = run.cells;
    in.marks = run.near.marks.span();
    in.shares = run.shares.span();
    in.closure = run.settings.closure;
    if (in.closure == GridClosure::kSh) damp_rings(in);
    in.unit_m2 = unit_m2(run);
    return in;
}

Status photon_grid_weigh(const Context& context, PhotonGridRun& run) {
    const Scene& scene = *run.scene;
    const PhotonGridSettings& settings = run.settings;
    run.budget_photons = run.budget.photons >= 0 ? run.budget.photons : settings.photons;
    run.ring = settings.ring;
    run.cells = photon_cells(settings, run.budget_photons, run.world->medium);
    if (kChecks && settings.closure == GridClosure::kCamera && run.world->medium.count > 1)
        return Status::bad_input(scene.file +
                                 ": photon_grid.closure: \"camera\" knows one medium, but the "
                                 "scene has several, allowed: sh, published, mean");
    PILEUS_TRY(choose_photon_lights(std::uint64_t(settings.generations), run));
    aim_deposit(run);
    PILEUS_TRY(plan_deposit(run));
    if (kPlans)
        run.plan.bias = {"photon-grid",
                         "cells and the bands left out blur the light of many orders",
                         "docs/photon-grid.md"};
    note_plan(run);
    return photon_grid_measure(context, run);
}

Status photon_grid_prepare(const Context& context, PhotonGridRun& run) {
    const Medium& medium = run.world->medium;
    // The values may show that there is no medium, or more of it than sizes tell.
    PILEUS_TRY(photon_grid_weigh(context, run));
    PILEUS_TRY(make_cell_majorants(medium, run.settings.local_tracking, run.cells, context,
                                   run.majorants, run.near));
    PILEUS_TRY(
        make_cell_shares(medium, run.cells, run.near.marks.span(), context.threads, run.shares));
    run.outlined_only = false;
    PILEUS_TRY(photon_grid_measure(context, run));
    if (kPlans && context.digests) run.digests = {{"density", density_digest(*run.world)}};
    return lay_out_photons(photon_grid_trace_input(context, run), run);
}

namespace {

/// Doubles the photons until the picture's mean relative standard error is as wanted, or the sums
/// hold all that is proven for them. The error is looked at after whole turns of the batches alone.
Status shoot_to_error(const FrameStep& step, const Context& context, PhotonGridRun& run,
                      const ShootPhotons& shoot) {
    const CameraParams camera =
        make_camera(run.scene->camera, orbit_at(*run.scene, step.frame), run.world->medium.low_m);
    const std::uint64_t most = wanted_generations(run, most_generations(run));
    const double start = wall_seconds(), seconds = run.budget.seconds;
    std::uint64_t count = run.generations < most ? run.generations : most;
    while (count > 0) {
        PILEUS_TRY(shoot_generations(
            context, run, count, [] {}, shoot));
        if (run.interrupted) break;
        const double left = seconds - (wall_seconds() - start);
        if (seconds > 0 && left <= 0) break;
        run.budget.seconds = seconds > 0 ? left : 0;
        Planes planes;
        PILEUS_TRY(photon_grid_compose(camera, context, run, planes));
        const ErrorSum sum = batch_error_sum(planes);
        if (sum.mean_relative() <= run.budget.error) break;
        const std::uint64_t held = run.next_generation;
        count = held * 2 <= most ? held : 0;
    }
    run.budget.seconds = seconds;
    return Status::ok();
}

}  // namespace

Status photon_grid_light(const FrameStep& step, const Context& context, PhotonGridRun& run) {
    const ShootPhotons shoot = [&] {
        return shoot_generation(photon_grid_trace_input(context, run), context, run);
    };
    const Scene& scene = *run.scene;
    if (run.ring) return light_photon_frame(step, context, run, shoot);
    // One sum: all photons anew for each frame, of the same random numbers, so that noise stays
    // where it is.
    if (scene.animation.present) {
        set_photon_sun(run.sun_of(step.frame), run);
        for (PhotonSlot& slot : run.photons.slots) empty_slot(slot, context.threads);
        run.next_generation = run.ring_first = 0;
    }
    if (run.budget.error > 0) {
        PILEUS_TRY(shoot_to_error(step, context, run, shoot));
        if (run.next_generation == 0) return interrupted_before("the first generation");
        return Status::ok();
    }
    const bool open = run.budget.seconds > 0 && run.budget.generations == 0;
    const std::uint64_t first = run.next_generation;
    PILEUS_TRY(shoot_generations(
        context, run, open ? most_generations(run) : planned_generations(run), [] {}, shoot));
    if (run.next_generation == first) return interrupted_before("the first generation");
    return Status::ok();
}

}  // namespace pileus
