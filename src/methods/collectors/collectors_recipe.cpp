// SPDX-License-Identifier: Apache-2.0
// Method `collectors` as a recipe: which of its functions a frame calls.
// in: scene, budget, frames -> out: generations shot, pictures.
// docs/collectors.md
#include "platform/clock.h"
#include "src/methods/collectors/collectors.h"

namespace pileus {
namespace {

struct Run : MethodRun {
    Budget budget;
    CollectorsRun collectors;
};

Run& own(MethodRun& run) { return static_cast<Run&>(run); }
const Run& own(const MethodRun& run) { return static_cast<const Run&>(run); }

std::unique_ptr<MethodRun> make() { return std::make_unique<Run>(); }

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

Status outline(const Scene& scene, const Budget& budget, const Context& context, MethodRun& run) {
    own(run).budget = budget;
    return collectors_outline(scene, collectors_photons(scene, budget), context,
                              own(run).collectors);
}

Status prepare(const Scene& scene, const Budget& budget, const Context& context, MethodRun& run) {
    own(run).budget = budget;
    return collectors_prepare(scene, collectors_photons(scene, budget), context,
                              own(run).collectors);
}

void report_plan(const MethodRun& run, const Context& context, Report& report) {
    collectors_report_plan(own(run).collectors, context, report);
}

Status light(const FrameStep& step, const Context& context, MethodRun& run) {
    return collectors_light(own(run).budget, step, context, own(run).collectors);
}

Status show(const FrameStep& step, const Context& context, MethodRun& run, Image& image) {
    CollectorsRun& collectors = own(run).collectors;
    if (step.last || collectors.interrupted) collectors_end_tracing(collectors);
    return collectors_show(orbit_at(*collectors.scene, step.frame), context, collectors, image);
}

void report(const MethodRun& run, Report& out) { collectors_report(own(run).collectors, out); }

Status shoot(const Budget& budget, const Context& context, CollectorsRun& run,
             std::uint64_t count) {
    const StageClock clock(context, "photons");
    const double start = wall_seconds();
    for (std::uint64_t g = 0; g < count; ++g) {
        if (context.stop()) {
            run.interrupted = true;
            break;
        }
        PILEUS_TRY(collectors_shoot(context, run));
        context.tell("photons", double(g + 1) / double(count));
        // Time only chooses a whole number of generations, which the report records.
        if (budget.seconds > 0 && wall_seconds() - start >= budget.seconds) break;
    }
    return Status::ok();
}

Status interrupted(const char* what) {
    return {Code::kCheckFailed, std::string("interrupted before ") + what + "; no file written"};
}

/// The ring of an animation is whole or nothing.
Status shoot_one(const Budget& budget, const Context& context, CollectorsRun& run) {
    PILEUS_TRY(shoot(budget, context, run, 1));
    return run.interrupted ? interrupted("the frame's ring of generations was whole")
                           : Status::ok();
}

}  // namespace

std::int64_t collectors_photons(const Scene& scene, const Budget& budget) {
    return budget.photons >= 0 ? budget.photons : scene.collectors.photons;
}

/// Frame f of an animation has the ring of generations f .. f + p - 1, whatever frames were asked
/// for, so that a part of an animation repeats the whole's bits.
Status collectors_light(const Budget& budget, const FrameStep& step, const Context& context,
                        CollectorsRun& run) {
    const Scene& scene = *run.scene;
    if (!step.first) {
        PILEUS_TRY(collectors_set_sun(sun_at(scene, step.frame), context, run));
        return shoot_one(budget, context, run);
    }
    if (!scene.animation.present) {
        PILEUS_TRY(shoot(budget, context, run, run.generations));
        return run.next_generation > 0 ? Status::ok() : interrupted("the first generation");
    }
    run.next_generation = std::uint64_t(step.frame);
    const std::uint64_t last = run.next_generation + run.generations;
    while (run.next_generation < last) {
        // Generation g >= p was shot for frame g - p + 1; those before it under frame 0's sun.
        const std::uint64_t g = run.next_generation;
        const int shown = g < run.generations ? 0 : int(g - run.generations + 1);
        PILEUS_TRY(collectors_set_sun(sun_at(scene, shown), context, run));
        PILEUS_TRY(shoot_one(budget, context, run));
    }
    return Status::ok();
}

const Method& collectors_method() {
    static constexpr Method method{"collectors", make,  check, outline, prepare,
                                   report_plan,  light, show,  report};
    return method;
}

}  // namespace pileus
