// SPDX-License-Identifier: Apache-2.0
// Method `photon-grid` as a recipe: which of its functions a frame calls.
// in: scene, budget, frames -> out: generations shot, pictures.
// docs/photon-grid.md
#include "kernels_cpu/core/profile.h"
#include "src/methods/check_support.h"
#include "src/methods/photon_grid/photon_grid.h"
#include "src/photons/lit_march.h"
#include "src/photons/photon_report.h"

namespace pileus {
namespace {

PhotonGridRun& own(MethodRun& run) { return static_cast<PhotonGridRun&>(run); }
const PhotonGridRun& own(const MethodRun& run) { return static_cast<const PhotonGridRun&>(run); }

std::unique_ptr<MethodRun> make() { return std::make_unique<PhotonGridRun>(); }

Status check_layers(const Scene& scene) {
    if (scene.output.layer_order && scene.sun.present && !scene.photon_grid.first_order_split)
        return Status::bad_input(scene.file +
                                 ": output.layers: \"order\": method photon-grid keeps single "
                                 "scattering apart only with first_order_split, allowed: "
                                 "photon_grid.first_order_split = true, or no such layer");
    return Status::ok();
}

/// A periodic medium is seen from many sides at once, a moved camera as well.
Status check_closure(const Scene& scene) {
    const GridClosure closure = scene.photon_grid.closure;
    if (closure == GridClosure::kSh) return Status::ok();
    const std::string where = scene.file + ": photon_grid.closure: ";
    bool periodic = false;
    for (const MediumSettings& m : scene.media) periodic |= m.periodic;
    if (periodic && !scene.camera.orthographic)
        return Status::bad_input(where +
                                 "not for periodic media, allowed: sh, or an orthographic camera");
    const char* mover = mover_of_view(scene);
    if (closure == GridClosure::kCamera && mover != nullptr)
        return Status::bad_input(where + "\"camera\" needs a fixed camera, but " + mover +
                                 " moves it");
    return Status::ok();
}

Status check(const Scene& scene, const Budget& budget) {
    if (budget.error > 0 && !scene.output.layer_error)
        return Status::bad_input(
            "--budget error: method photon-grid knows its error by batches of photons, allowed: "
            "output.layers with \"error\"");
    if (budget.error > 0 && scene.animation.present)
        return Status::bad_input(
            "--budget error: not for an animation by photon-grid, whose frames have the same "
            "photons, "
            "allowed: photons=N");
    PILEUS_TRY(check_budget_kinds(scene, budget));
    PILEUS_TRY(check_layers(scene));
    return check_closure(scene);
}

Status outline(const Context& context, MethodRun& run) {
    if (kDevices && context.kernels->device != nullptr)
        return Status::bad_input(std::string("--isa: \"") + context.kernels->name +
                                 "\": method photon-grid runs on the host alone, allowed: another, "
                                 "or another method");
    PhotonGridRun& grid = own(run);
    grid.settings = run.scene->photon_grid;
    grid.thin = grid.settings.thin;
    grid.light_refresh = grid.settings.light_refresh;
    if (kChecks) PILEUS_TRY(check_thinned(context, *run.scene, "photon_grid", grid.thin));
    return photon_grid_weigh(context, grid);
}

Status prepare(const Context& context, MethodRun& run) {
    return photon_grid_prepare(context, own(run));
}

Status light(const FrameStep& step, const Context& context, MethodRun& run) {
    return photon_grid_light(step, context, own(run));
}

Status show(const FrameStep& step, const Context& context, MethodRun& method_run, Image& image) {
    PhotonGridRun& run = own(method_run);
    if (step.last || run.interrupted) {
        run.scratch.sums = Buffer<std::int64_t>();
        run.majorants.tracking = Buffer<float>();
    }
    run.turn = run.frame = step.frame;
    return photon_grid_show(orbit_at(*run.scene, step.frame), context, run, image);
}

void count(const MethodRun& run, Counts& counters) { count_photons(own(run), counters); }

void report(const MethodRun& run, Report& out) { photon_grid_report(own(run), out); }

template <GridSlices kWhat>
Status show_slices(const FrameStep& step, const Context& context, MethodRun& run, Image& image) {
    return photon_grid_show_slices(kWhat, orbit_at(*run.scene, step.frame), context, own(run),
                                   image);
}

Status outline_slices(const Context& context, MethodRun& run) {
    if (run.scene->photon_grid.closure == GridClosure::kCamera)
        return Status::bad_input(run.scene->file +
                                 ": photon_grid.closure: \"camera\" keeps neither flux nor "
                                 "directions to show, allowed: sh, published, mean");
    return outline(context, run);
}

template <GridSlices kWhat>
constexpr Recipe slices(const char* name) {
    return {name,  WorldUse::kGrid,    make,  check,  outline_slices,     prepare,
            light, show_slices<kWhat>, count, report, photon_budget_used, nullptr,
            false};
}

/// The ring follows a light that has moved; one sum begins anew.
Status aim(int, bool anew, const Context& context, MethodRun& method_run) {
    PhotonGridRun& run = own(method_run);
    const Lighting before = run.lighting;
    const DepositPlan deposit = run.deposit;
    const bool placed = !anew && relight_photons(run);
    run.upsample.ready &= placed;
    const CameraParams camera = make_camera(run.scene->camera, 0, run.world->medium.low_m);
    bool turned = false;
    for (int a = 0; a < 3 && run.settings.closure == GridClosure::kCamera; ++a)
        turned |= deposit.camera[a] !=
                  (run.scene->camera.orthographic ? -camera.forward[a] : camera.origin[a]);
    if (!placed || turned) {
        if (run.sealed) return refuse_new_lights();
        PILEUS_TRY(photon_grid_weigh(context, run));
        forget_sun_shadow(run);
        return lay_out_photons(photon_grid_trace_input(context, run), run);
    }
    if (run.ring || same_lights(before, run.lighting)) return Status::ok();
    for (PhotonSlot& slot : run.photons.slots) empty_slot(slot, context.threads);
    run.next_generation = run.ring_first = 0;
    run.photons.tallies.assign(run.lighting.lights.size(), TraceTally{});
    return Status::ok();
}

Status advance(std::uint64_t units, const Context& context, MethodRun& method_run,
               std::uint64_t& done) {
    PhotonGridRun& run = own(method_run);
    const std::uint64_t held = run.next_generation - run.ring_first;
    const std::uint64_t most = most_generations(run);
    // One sum takes no more than was proven for it.
    if (!run.ring && held + units > most) units = held < most ? most - held : 0;
    const ShootPhotons shoot = [&] {
        return shoot_generation(photon_grid_trace_input(context, run), context, run);
    };
    return advance_photons(units, context, run, shoot, done);
}

LightUnits units(const MethodRun& run) { return photon_units(own(run)); }

void put_tables(const FrameWork& work, const MethodRun&, MethodTables& tables) {
    put_work(work, tables.photon_grid.thin);
    tables.photon_grid.light_refresh = work.light_refresh;
}

Status most_units(const FrameWork& work, const MethodRun& run, FrameUnits& out) {
    return photon_most_units(work, own(run), out);
}

Status compose(const FrameStep& step, const Context& context, MethodRun& method_run,
               Planes*& planes) {
    PhotonGridRun& run = own(method_run);
    run.frame = step.frame;
    ++run.turn;
    const CameraParams camera = make_camera(run.scene->camera, 0, run.world->medium.low_m);
    planes = &run.planes;
    run.planes.late = late_photons(step.late, run.thin, camera, step.frame, run);
    return photon_grid_compose(camera, context, run, run.planes);
}

}  // namespace

void photon_grid_report(const PhotonGridRun& run, Report& report) {
    report_photons(run, report);
    const std::uint64_t numbers =
        std::uint64_t(run.deposit.channels) * std::uint64_t(run.deposit.coefficients);
    report.executed.emplace_back("cells", run.cells.count());
    report.executed.emplace_back("cells_near_medium", run.near.marked);
    report.executed.emplace_back("coefficients",
                                 numbers * run.lighting.lights.size() * run.photons.slots.size());
    if (run.digests.empty()) return;
    report.digests.insert(report.digests.begin(), {"photons", photon_digest(run.photons)});
    report.digests.insert(report.digests.begin(), run.digests.begin(), run.digests.end());
}

const Recipe* photon_grid_views(int& count) {
    static constexpr Recipe all[] = {slices<GridSlices::kFlux>("flux-slices"),
                                     slices<GridSlices::kAnisotropy>("anisotropy-slices")};
    count = int(sizeof all / sizeof all[0]);
    return all;
}

const Recipe& photon_grid_method() {
    static constexpr LiveMethod live{aim,
                                     advance,
                                     units,
                                     compose,
                                     photon_full_work,
                                     set_photon_limits,
                                     kept(kChecks, put_tables),
                                     most_units};
    static constexpr Recipe method{"photon-grid",
                                   WorldUse::kGrid,
                                   make,
                                   kept(kChecks, check),
                                   outline,
                                   prepare,
                                   kept(kFilms, light),
                                   kept(kFilms, show),
                                   count,
                                   kept(kPlans, report),
                                   kept(kPlans, photon_budget_used),
                                   &live};
    return method;
}

}  // namespace pileus
