// SPDX-License-Identifier: Apache-2.0
// Method `collectors` as a recipe: which of its functions a frame calls.
// in: scene, budget, frames -> out: generations shot, pictures.
// docs/collectors.md
#include "kernels_cpu/core/profile.h"
#include "src/methods/check_support.h"
#include "src/methods/collectors/collectors.h"
#include "src/photons/lit_march.h"
#include "src/photons/photon_frames.h"
#include "src/picture/late_rows.h"

namespace pileus {
namespace {

CollectorsRun& own(MethodRun& run) { return static_cast<CollectorsRun&>(run); }
const CollectorsRun& own(const MethodRun& run) { return static_cast<const CollectorsRun&>(run); }

std::unique_ptr<MethodRun> make() { return std::make_unique<CollectorsRun>(); }

Status check(const Scene& scene, const Budget& budget) {
    PILEUS_TRY(check_budget_kinds(scene, budget));
    const CollectorSettings& settings = scene.collectors;
    if (scene.output.layer_order && scene.sun.present && !settings.first_order_split &&
        !settings.camera_closure)
        return Status::bad_input(scene.file +
                                 ": output.layers: \"order\": method collectors keeps single "
                                 "scattering apart only with first_order_split, allowed: "
                                 "collectors.first_order_split = true, or no such layer");
    return Status::ok();
}

Status outline(const Context& context, MethodRun& run) {
    return collectors_outline(context, own(run));
}

Status prepare(const Context& context, MethodRun& run) {
    return collectors_prepare(context, own(run));
}

Status light(const FrameStep& step, const Context& context, MethodRun& run) {
    return collectors_light(step, context, own(run));
}

Status show(const FrameStep& step, const Context& context, MethodRun& run, Image& image) {
    CollectorsRun& collectors = own(run);
    if (step.last || collectors.interrupted) collectors_end_tracing(collectors);
    collectors.turn = collectors.frame = step.frame;
    return collectors_show(orbit_at(*collectors.scene, step.frame), context, collectors, image);
}

void count(const MethodRun& run, Counts& counters) { collectors_count(own(run), counters); }

void report(const MethodRun& run, Report& out) { collectors_report(own(run), out); }

ShootPhotons shooting(const Context& context, CollectorsRun& run) {
    return [&] { return collectors_shoot(context, run); };
}

}  // namespace

Status collectors_light(const FrameStep& step, const Context& context, CollectorsRun& run) {
    return light_photon_frame(step, context, run, shooting(context, run));
}

namespace {

Status aim(int, bool anew, const Context& context, MethodRun& run) {
    return collectors_relight(anew, context, own(run));
}

Status advance(std::uint64_t units, const Context& context, MethodRun& run, std::uint64_t& done) {
    return advance_photons(units, context, own(run), shooting(context, own(run)), done);
}

LightUnits units(const MethodRun& run) { return photon_units(own(run)); }

void put_tables(const FrameWork& work, const MethodRun& run, MethodTables& tables) {
    if (own(run).thins) put_work(work, tables.collectors.thin);
    tables.collectors.light_refresh = work.light_refresh;
}

Status most_units(const FrameWork& work, const MethodRun& run, FrameUnits& out) {
    if (own(run).settings.billboards)
        return Status::bad_input(
            "units: what billboards take depends on the view, allowed: display = \"march\"");
    return photon_most_units(work, own(run), out);
}

Status compose(const FrameStep& step, const Context& context, MethodRun& method_run,
               Planes*& planes) {
    CollectorsRun& run = own(method_run);
    run.frame = step.frame;
    ++run.turn;
    const CameraParams camera = make_camera(run.scene->camera, 0, run.world->medium.low_m);
    CollectorColours colours;
    planes = &run.planes;
    run.planes.late = late_photons(step.late, run.thin, camera, step.frame, run);
    return collectors_compose(camera, context, run, colours, run.planes);
}

}  // namespace

const Recipe& collectors_method() {
    static constexpr LiveMethod live{aim,
                                     advance,
                                     units,
                                     compose,
                                     photon_full_work,
                                     set_photon_limits,
                                     kept(kChecks, put_tables),
                                     most_units};
    static constexpr Recipe method{"collectors",
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
