// SPDX-License-Identifier: Apache-2.0
// A frame of a film: lights, view, light, picture, image.
// in: an open session, a frame -> out: an image with the scene's layers; the report's part of it.
// docs/architecture.md, "Methods"
#include <optional>

#include "platform/clock.h"
#include "platform/fp_mode.h"
#include "src/base/file.h"
#include "src/picture/finish_frame.h"
#include "src/run/work_share.h"
#include "src/session/session.h"
#include "src/session/stop_rule.h"

namespace pileus {

/// Where the light of a frame is kept, so that a later run goes on with it.
struct StateFile {
    const MethodReport& of;
    const std::string path;  ///< empty: it is not kept
    double every_s, last_s;

    Status save() const { return path.empty() ? Status::ok() : of.save(path); }
    Status save_now_and_then() {
        if (path.empty() || wall_seconds() - last_s < every_s) return Status::ok();
        PILEUS_TRY(save());
        last_s = wall_seconds();
        return Status::ok();
    }
};

namespace {

/// The frame's own, where there are several.
std::string state_path(const Scene& scene, const Budget& budget, int frame) {
    const bool several = scene.animation.is_film();
    if (budget.state.empty() || !several) return budget.state;
    return numbered_path(budget.state, frame);
}

}  // namespace

Status Session::film_passes(const FrameView& view, const LightGoal& goal, StateFile& file) {
    Method& method = *made_.method;
    const char* const stage = method.progress().stage;
    const StopRule rule(goal);
    std::optional<StageClock> clock(std::in_place, context_, stage);
    context_.hold(true);
    const double start = wall_seconds();
    LightPass last;
    for (;;) {
        LightUnits light = method.progress();
        double error = 0;
        // A picture that an error is told by has stages of its own.
        if (rule.wants_error(light) && goal.doubles) clock.reset();
        const bool looks = rule.wants_error(light);
        if (looks && context_.sharing != nullptr)
            PILEUS_TRY(made_.report->bring_together(*context_.sharing));
        if (looks && is_first()) PILEUS_TRY(made_.report->error(context_, view, error));
        const double spent_s = wall_seconds() - start;
        last.units = rule.met(light, error) ? 0 : rule.next(light, spent_s, last);
        if (context_.sharing != nullptr) PILEUS_TRY(context_.sharing->decide(last.units));
        if (last.units == 0) break;
        if (!clock) clock.emplace(context_, stage);
        std::uint64_t done = 0;
        PILEUS_TRY(method.accumulate(context_, view, last.units, done));
        last.seconds = wall_seconds() - start - spent_s;
        light = method.progress();
        if (light.interrupted) break;
        context_.tell(stage, rule.share_done(light, wall_seconds() - start));
        // Of several processes the first keeps what all have, once it is whole.
        if (context_.sharing == nullptr) PILEUS_TRY(file.save_now_and_then());
    }
    return context_.sharing != nullptr ? made_.report->bring_together(*context_.sharing)
                                       : Status::ok();
}

Status Session::film_light(const FrameView& view) {
    Method& method = *made_.method;
    if (method.progress().stage == nullptr) return Status::ok();
    const LightGoal goal = made_.report->goal(view);
    StateFile file{*made_.report, state_path(scene_, options_.budget, view.frame),
                   options_.budget.state_every_s, wall_seconds()};
    if (!file.path.empty()) PILEUS_TRY(made_.report->resume(context_, view, file.path));
    std::uint64_t done = 0;
    PILEUS_TRY(method.accumulate(context_, view, 0, done));
    PILEUS_TRY(film_passes(view, goal, file));
    const LightUnits light = method.progress();
    if (light.held > 0) return is_first() ? file.save() : Status::ok();
    const bool keeps = !file.path.empty() && light.part;
    if (keeps) PILEUS_TRY(file.save());
    return {Code::kCheckFailed,
            std::string("interrupted before ") + goal.first + "; " +
                (keeps ? "no picture written, progress kept in " + file.path : "no file written")};
}

bool Session::is_first() const {
    return context_.sharing == nullptr || context_.sharing->part().is_first();
}

/// A film tells of no change: methods see by themselves that the sun has moved.
Status Session::film_view(int frame, bool new_run) {
    scenery_.light(frame);
    ViewChange change;
    change.new_run = new_run;
    return made_.method->set_view(context_, scenery_.view(frame), change);
}

Status Session::film_generation(std::uint64_t number, std::uint64_t ring) {
    // Those before the first whole ring are shot under frame 0's sun.
    const int shown = number < ring ? 0 : int(number - ring + 1);
    move_to(shown);
    PILEUS_TRY(film_view(shown, false));
    std::uint64_t done = 0;
    return made_.method->accumulate(context_, scenery_.view(shown), 1, done);
}

Status Session::film_ring(const FilmFrame& step) {
    Method& method = *made_.method;
    const std::uint64_t ring = method.progress().ring, frame = std::uint64_t(step.frame);
    const LightGoal goal = made_.report->goal(scenery_.view(step.frame));
    // Whatever frames were asked for: a part of a film repeats the whole's bits.
    const std::uint64_t first = step.first ? frame : frame + ring - 1;
    const std::uint64_t end = step.first ? frame + goal.most : frame + ring;
    if (step.first) method.restart(context_, first);
    {
        const char* const stage = method.progress().stage;
        const StageClock clock(context_, stage);
        context_.hold(true);
        const double start = wall_seconds();
        for (std::uint64_t number = first; number < end; ++number) {
            PILEUS_TRY(film_generation(number, ring));
            if (method.progress().interrupted) break;
            context_.tell(stage, double(number + 1 - first) / double(end - first));
            // Time only chooses a whole number of generations, which the report records.
            if (goal.seconds > 0 && wall_seconds() - start >= goal.seconds) break;
        }
    }
    move_to(step.frame);
    if (!method.progress().interrupted) return film_view(step.frame, step.new_run);
    return {Code::kCheckFailed,
            "interrupted before the frame's ring of generations was whole; no file written"};
}

Status Session::light_frame(const FilmFrame& step) {
    Method& method = *made_.method;
    const LightUnits light = method.progress();
    if (light.ring > 0) return film_ring(step);
    // The same random numbers in each frame, so that noise stays where it is.
    if (light.one_sum && scene_.animation.present) method.restart(context_, 0);
    PILEUS_TRY(film_view(step.frame, step.new_run));
    if (!options_.parts) return film_light(scenery_.view(step.frame));
    std::uint64_t done = 0;
    PILEUS_TRY(method.accumulate(context_, scenery_.view(step.frame), 0, done));
    return options_.parts(*made_.report);
}

Status Session::film_frame(const FilmFrame& step, Image& image) {
    PILEUS_TRY(light_frame(step));
    return is_first() ? show_frame(step, image) : Status::ok();
}

Status Session::render_light(const FilmFrame& step, PartLight& light) {
    const FpModeGuard guard;
    const PoolGuard lent(*threads_);
    PILEUS_TRY(take_frame(step.frame));
    PILEUS_TRY(light_frame(step));
    if (made_.method->progress().interrupted)
        return {Code::kCheckFailed, "interrupted before the part was whole; no file written"};
    return made_.report->take_light(light);
}

Status Session::set_window(const Camera& camera) {
    const bool same =
        camera.resolution == scene_.camera.resolution && camera.window == scene_.camera.window;
    for (Camera* own : {&scene_.camera, &host_.camera}) {
        own->resolution = camera.resolution;
        own->window = camera.window;
    }
    if (same || !scenery_.environment.depth.present) return Status::ok();
    return load_environment(scene_, context_, scenery_.environment);
}

Status Session::show_frame(const FilmFrame& step, Image& image) {
    Method& method = *made_.method;
    const FrameView view = scenery_.view(step.frame);
    method.release(Phase::kTraced);
    if (step.last || method.progress().interrupted) method.release(Phase::kEnded);
    report_.digests = digests_;
    if (!options_.show.empty()) return made_.report->draw(context_, view, image);
    Planes* planes = nullptr;
    PILEUS_TRY(draw(view, {}, planes));
    PILEUS_TRY(made_.report->add_layers(context_, view));
    made_.report->digest_picture(context_, report_.digests);
    PILEUS_TRY(finish_frame(context_, scene_.output, world(), scenery_.environment.depth,
                            view.camera, made_.report->finished(), *planes, image, report_));
    method.release(Phase::kShown);
    return Status::ok();
}

}  // namespace pileus
