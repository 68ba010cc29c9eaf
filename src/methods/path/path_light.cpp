// SPDX-License-Identifier: Apache-2.0
// One frame of the path tracer: alpha, then passes until the budget is met.
// in: a prepared PathRun -> out: its film, and the state file where one is kept.
// docs/program.md, "Budgets of a path tracing"
#include "kernels_cpu/core/profile.h"
#include "platform/clock.h"
#include "src/base/file.h"
#include "src/methods/path/path.h"
#include "src/methods/path/path_passes.h"
#include "src/methods/path/path_state.h"
#include "src/picture/march_view.h"

namespace pileus {
namespace {

/// What the medium shows along the rays through pixel centres; a flat detector has no such rays.
Status make_alpha(const Context& context, PathRun& run) {
    const OutputSettings& output = run.scene->output;
    // Colours are the film's, and stay where they are.
    Buffer<float> colour;
    colour.swap(run.planes.colour);
    const Status room =
        allocate_planes(run.camera.width, run.camera.height, 0, run.lighting.opaque(),
                        run.scene->wants_depth(), run.planes);
    colour.swap(run.planes.colour);
    if (!room) return room;
    if (run.camera.flux != 0) return Status::ok();  // alpha 1: all pixels are measured
    if (path_regresses(run.filter))
        return march_guides(context, run.world->medium, run.majorants, run.lighting, run.camera,
                            run.scene->wants_depth(), run.planes, run.guides);
    const MarchWanted wanted{run.scene->wants_depth(), output.layer_optical_depth};
    return march_medium(context, run.world->medium, run.majorants, run.lighting, run.camera, wanted,
                        run.planes);
}

bool is_met(const PassRule& rule, const PathRun& run) {
    if (run.film.samples >= rule.most) return true;
    return rule.error > 0 && is_check(run.film.samples) &&
           path_error(run).mean_relative() <= rule.error;
}

/// How far the tracing is, by what will end it first.
double share_done(const PassRule& rule, const Film& film, double spent_s) {
    const double samples = double(film.samples) / double(rule.most);
    const double time = rule.seconds > 0 ? spent_s / rule.seconds : 0;
    return samples > time ? samples : time;
}

struct Keeper {
    const std::string path;  ///< empty: no state is kept
    std::uint64_t digest;
    double every_s, last_s;

    Status save(const Film& film) const {
        return path.empty() ? Status::ok() : write_path_state(path, digest, film);
    }
    Status save_now_and_then(const Film& film) {
        if (path.empty() || wall_seconds() - last_s < every_s) return Status::ok();
        PILEUS_TRY(save(film));
        last_s = wall_seconds();
        return Status::ok();
    }
};

/// Passes until the rule is met or the user wants an end.
Status trace_passes(const PassRule& rule, const Context& context, PathInput in, Keeper& keeper,
                    PathRun& run) {
    const StageClock clock(context, "paths");
    context.hold(true);
    const double start = wall_seconds();
    std::uint64_t last = 0;
    double last_s = 0;
    while (!is_met(rule, run)) {
        const double spent_s = wall_seconds() - start;
        const double each_s = last > 0 ? last_s / double(last) : 0;
        const bool late = rule.seconds > 0 && rule.seconds - spent_s <= 0.5 * each_s;
        if (run.film.samples > 0 && late) break;
        if (context.stop()) {
            run.interrupted = true;
            break;
        }
        const std::uint64_t count =
            pass_samples(rule, run.film.samples, last, last_s, rule.seconds - spent_s);
        in.ended = patient_stop(context);
        PILEUS_TRY(trace_paths(in, count, run.scratch, run.film));
        last = count;
        last_s = wall_seconds() - start - spent_s;
        context.tell("paths", share_done(rule, run.film, wall_seconds() - start));
        PILEUS_TRY(keeper.save_now_and_then(run.film));
    }
    return Status::ok();
}

/// Takes up what an earlier run has left, if anything.
Status resume(const PassRule& rule, const Keeper& keeper, PathRun& run) {
    if (keeper.path.empty()) return Status::ok();
    PILEUS_TRY(can_write_file(keeper.path));
    PILEUS_TRY(read_path_state(keeper.path, keeper.digest, run.film));
    add_tally(run.film.tally, run.earlier);
    const std::uint64_t samples = run.film.samples + run.film.ahead_samples;
    if (samples <= rule.most) return Status::ok();
    return Status::bad_input(keeper.path + ": state: holds " + std::to_string(samples) +
                             " samples per pixel, " + std::to_string(rule.most) +
                             " asked for, allowed: as many or more, or another file");
}

/// A host sees light before its media and behind, and no errors: but for a filter, which reads all.
PathInput live_input(const Context& context, const PathRun& run) {
    PathInput in = path_input(context, run);
    in.brief = !path_filters(run.filter);
    return in;
}

}  // namespace

Status path_begin(const Context& context, PathRun& run) {
    const PathInput in = live_input(context, run);
    add_tally(run.film.tally, run.tally);
    PILEUS_TRY(make_film(in, run.film));
    PILEUS_TRY(make_alpha(context, run));
    run.begun = true;
    return run.scratch.ready ? Status::ok() : prepare_path(in, run.scratch);
}

Status path_advance(std::uint64_t samples, const Context& context, PathRun& run) {
    const StageClock clock(context, "paths");
    PathInput in = live_input(context, run);
    run.interrupted = false;
    if (!kStops || !context.interrupted) return trace_paths(in, samples, run.scratch, run.film);
    // Who may end it is asked between passes; the bits are those of one.
    PassRule rule;
    rule.most = run.film.samples + samples;
    std::uint64_t last = 0;
    double last_s = 0;
    while (run.film.samples < rule.most) {
        run.interrupted = context.stop();
        if (run.interrupted) break;
        const double start = wall_seconds();
        last = pass_samples(rule, run.film.samples, last, last_s, 0);
        in.ended = patient_stop(context);
        PILEUS_TRY(trace_paths(in, last, run.scratch, run.film));
        last_s = wall_seconds() - start;
    }
    return Status::ok();
}

Status path_light(const FrameStep& step, const Context& context, MethodRun& method_run) {
    PathRun& run = static_cast<PathRun&>(method_run);
    const PathInput in = path_input(context, run);
    const PassRule rule = pass_rule(run.settings, run.budget);
    PILEUS_TRY(make_film(in, run.film));
    const bool several = run.scene->animation.present && run.scene->animation.frames > 1;
    Keeper keeper{
        run.budget.state.empty() || !several ? run.budget.state
                                             : numbered_path(run.budget.state, step.frame),
        path_state_digest(in, context.report->version), run.budget.state_every_s, wall_seconds()};
    PILEUS_TRY(resume(rule, keeper, run));
    PILEUS_TRY(make_alpha(context, run));
    PILEUS_TRY(prepare_path(in, run.scratch));

    PILEUS_TRY(trace_passes(rule, context, in, keeper, run));
    if (run.film.samples == 0) {
        const bool keeps = !keeper.path.empty() && run.film.ahead > 0;
        if (keeps) PILEUS_TRY(keeper.save(run.film));
        return {Code::kCheckFailed,
                "interrupted before the first sample of every pixel; " +
                    (keeps ? "no picture written, progress kept in " + keeper.path
                           : std::string("no file written"))};
    }
    PILEUS_TRY(keeper.save(run.film));
    run.scratch = PathScratch{};
    add_tally(run.film.tally, run.tally);
    run.film.tally = PathTally{};
    return Status::ok();
}

}  // namespace pileus
