// SPDX-License-Identifier: Apache-2.0
// Method `collectors` as a recipe: which of its functions a frame calls.
// in: scene, budget, frames -> out: generations shot, pictures.
// docs/collectors.md
#include <algorithm>

#include "platform/clock.h"
#include "src/methods/collectors/collectors.h"

namespace pileus {
namespace {

CollectorsRun& own(MethodRun& run) { return static_cast<CollectorsRun&>(run); }
const CollectorsRun& own(const MethodRun& run) { return static_cast<const CollectorsRun&>(run); }

std::unique_ptr<MethodRun> make() { return std::make_unique<CollectorsRun>(); }

Status check(const Scene& scene, const Budget& budget) {
    constexpr const char* kAllowed = "photons=N, seconds=S";
    if (budget.samples >= 0) return unknown_budget("--budget samples", scene.method, kAllowed);
    if (budget.steps >= 0) return unknown_budget("--budget steps", scene.method, kAllowed);
    if (budget.error > 0) return unknown_budget("--budget error", scene.method, kAllowed);
    if (!budget.state.empty())
        return unknown_budget("--state", scene.method, "method.name = \"path\"");
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

void report_plan(const MethodRun& run, const Context& context, Report& report) {
    collectors_report_plan(own(run), context, report);
}

Status light(const FrameStep& step, const Context& context, MethodRun& run) {
    return collectors_light(step, context, own(run));
}

Status show(const FrameStep& step, const Context& context, MethodRun& run, Image& image) {
    CollectorsRun& collectors = own(run);
    if (step.last || collectors.interrupted) collectors_end_tracing(collectors);
    return collectors_show(orbit_at(*collectors.scene, step.frame), context, collectors, image);
}

void report(const MethodRun& run, Report& out) { collectors_report(own(run), out); }

/// Up to `count` generations, fewer where the time is up or the user wants an end. `aim` does what
/// the next one asks for first.
template <class Aim>
Status shoot(const Context& context, CollectorsRun& run, std::uint64_t count, Aim aim) {
    const StageClock clock(context, "photons");
    const double start = wall_seconds();
    context.hold(true);
    for (std::uint64_t g = 0; g < count; ++g) {
        run.interrupted = context.stop();
        if (run.interrupted) break;
        PILEUS_TRY(aim());
        PILEUS_TRY(collectors_shoot(context, run));
        if (run.interrupted) break;
        context.tell("photons", double(g + 1) / double(count));
        // Time only chooses a whole number of generations, which the report records.
        if (run.budget.seconds > 0 && wall_seconds() - start >= run.budget.seconds) break;
    }
    return Status::ok();
}

Status interrupted(const char* what) {
    return {Code::kCheckFailed, std::string("interrupted before ") + what + "; no file written"};
}

/// The ring of an animation is whole, or as far as the time went.
Status ring_state(const CollectorsRun& run) {
    return run.interrupted ? interrupted("the frame's ring of generations was whole")
                           : Status::ok();
}

/// Fills the ring of the first frame that is asked for. Frame f has generations f .. f + p - 1.
Status fill_ring(int frame, const Context& context, CollectorsRun& run) {
    run.next_generation = std::uint64_t(frame);
    PILEUS_TRY(shoot(context, run, run.generations, [&] {
        // Generation g >= p was shot for frame g - p + 1; those before it under frame 0's sun.
        const std::uint64_t g = run.next_generation;
        const int shown = g < run.generations ? 0 : int(g - run.generations + 1);
        return collectors_set_sun(sun_at(*run.scene, shown), context, run);
    }));
    // Time cut it short: what there is begins at the first slot, so that no gap lies before it.
    std::vector<PhotonSlot>& slots = run.photons.slots;
    if (run.next_generation - std::uint64_t(frame) < slots.size()) {
        run.ring_first = std::uint64_t(frame);
        std::rotate(slots.begin(), slots.begin() + std::ptrdiff_t(run.ring_first % slots.size()),
                    slots.end());
        PILEUS_TRY(collectors_set_sun(sun_at(*run.scene, frame), context, run));
    }
    return ring_state(run);
}

}  // namespace

std::int64_t collectors_photons(const Scene& scene, const Budget& budget) {
    return budget.photons >= 0 ? budget.photons : scene.collectors.photons;
}

/// Frame f of an animation has the ring of generations f .. f + p - 1, whatever frames were asked
/// for, so that a part of an animation repeats the whole's bits.
Status collectors_light(const FrameStep& step, const Context& context, CollectorsRun& run) {
    const Scene& scene = *run.scene;
    const auto nothing = [] { return Status::ok(); };
    if (!step.first) {
        PILEUS_TRY(collectors_set_sun(sun_at(scene, step.frame), context, run));
        PILEUS_TRY(shoot(context, run, 1, nothing));
        return ring_state(run);
    }
    if (scene.animation.present) return fill_ring(step.frame, context, run);
    PILEUS_TRY(shoot(context, run, run.generations, nothing));
    return run.next_generation > 0 ? Status::ok() : interrupted("the first generation");
}

namespace {

Status aim(int, bool anew, const Context& context, MethodRun& run) {
    return collectors_relight(anew, context, own(run));
}

Status advance(std::uint64_t units, const Context& context, MethodRun& method_run,
               std::uint64_t& done) {
    CollectorsRun& run = own(method_run);
    const StageClock clock(context, "photons");
    for (done = 0; done < units; ++done) {
        run.interrupted = context.stop();
        if (run.interrupted) return Status::ok();
        // The ledger is that of the last turn of the ring, so that its bounds hold for ever.
        if ((run.next_generation - run.ring_first) % run.generations == 0)
            run.photons.tallies.assign(run.lighting.lights.size(), TraceTally{});
        PILEUS_TRY(collectors_shoot(context, run));
        if (run.interrupted) return Status::ok();
        context.tell("photons", double(done + 1) / double(units));
    }
    return Status::ok();
}

LightUnits units(const MethodRun& method_run) {
    const CollectorsRun& run = own(method_run);
    LightUnits out;
    out.unit = "generation";
    out.whole = run.generations;
    for (const Light& light : run.lighting.lights) out.unit_photons += light.photons;
    for (const PhotonSlot& slot : run.photons.slots) out.held += slot.generations;
    out.prepared = run.layouts;
    return out;
}

Status compose(const FrameStep&, const Context& context, MethodRun& method_run,
               const Planes*& planes) {
    CollectorsRun& run = own(method_run);
    const CameraParams camera = make_camera(run.scene->camera, 0, run.world->medium.low_m);
    CollectorColours colours;
    int channels = 3;
    planes = &run.planes;
    return collectors_compose(camera, context, run, colours, channels, run.planes);
}

}  // namespace

const Method& collectors_method() {
    static constexpr LiveMethod live{aim, advance, units, compose};
    static constexpr Method method{"collectors", SkyUse::kOnGrid, make, check,  outline, prepare,
                                   report_plan,  light,           show, report, &live};
    return method;
}

}  // namespace pileus
