// SPDX-License-Identifier: Apache-2.0
// See render.h. The walk through a method's recipe, frame by frame.
#include "src/session/render.h"

#include "platform/clock.h"
#include "platform/fp_mode.h"
#include "src/io/images/image_file.h"
#include "src/session/run_context.h"
#include "src/session/warnings.h"

namespace pileus {
namespace {

/// The clocks when rendering began.
struct RunStart {
    double wall_s = wall_seconds(), cpu_s = cpu_seconds();
};

void finish_report(const RunStart& start, Report& report) {
    report.total_s = wall_seconds() - start.wall_s;
    report.cpu_s = cpu_seconds() - start.cpu_s;
    report.peak_bytes = peak_memory_bytes();
    for (const StageTime& s : report.stages)
        if (s.name == "photons" || s.name == "paths") {
            report.tracing_wall_s = s.wall_s;
            report.tracing_cpu_s = s.cpu_s;
        }
}

/// Names the picture by its bits before anything else is written about it.
void take_hash(const Image& image, Report& report) {
    report.hash = pixel_hash(image);
    report.digests.emplace_back("image", report.hash);
}

/// What another run needs, beside the scene's text, to make the same picture. Nothing of the
/// machine.
void note_origin(const Report& report, Image& image) {
    const auto add = [&](const std::string& name, const std::string& text) {
        if (!text.empty()) image.origin.emplace_back(name, text);
    };
    add("version", report.version);
    add("method", report.method);
    add("seed", std::to_string(report.seed));
    add("frame", std::to_string(report.frame));
    add("firstFrame", std::to_string(report.first_frame));
    add("budget", report.budget);
    add("show", report.show);
    if (report.generations > 0) add("generations", std::to_string(report.generations));
    if (report.samples_per_pixel > 0)
        add("samplesPerPixel", std::to_string(report.samples_per_pixel));
    for (std::size_t i = 0; i < report.overrides.size(); ++i)
        add("override." + std::to_string(i), report.overrides[i]);
}

/// Completes a frame's picture and report, and hands both over.
Status deliver(const Scene& scene, const RunStart& start, int frame, const FrameSink& sink,
               Image& image, Report& report) {
    image.pixel_hash = report.hash;
    image.scene_text = scene.text;
    report.frame = frame;
    note_origin(report, image);
    finish_report(start, report);
    return sink(frame, image, report);
}

Status render_frames(const Scene& scene, const Method& method, const RenderOptions& options,
                     const Context& context, const Frames& frames, const FrameSink& sink) {
    const RunStart start;
    Report& report = *context.report;
    const std::unique_ptr<MethodRun> run = method.make();
    PILEUS_TRY(method.prepare(scene, budget_of(options), context, *run));
    method.report_plan(*run, context, report);
    for (int frame = frames.first; frame <= frames.last && !report.interrupted; ++frame) {
        const RunStart frame_start;
        const FrameStep step{frame, frame == frames.first, frame == frames.last};
        PILEUS_TRY(method.light(step, context, *run));
        Image image;
        report.digests.clear();
        PILEUS_TRY(method.show(step, context, *run, image));
        take_hash(image, report);
        method.report(*run, report);
        if (options.show.empty()) find_warnings(scene, image, report);
        report.frame_wall_s = wall_seconds() - frame_start.wall_s;
        report.frame_cpu_s = cpu_seconds() - frame_start.cpu_s;
        context.hold(true);
        PILEUS_TRY(deliver(scene, start, frame, sink, image, report));
        context.hold(false);
    }
    return Status::ok();
}

}  // namespace

Status render(const Scene& scene, const RenderOptions& options, const FrameSink& sink) {
    const FpModeGuard guard;
    Report report;
    Context context;
    Frames frames{};
    const Method* method = nullptr;
    PILEUS_TRY(make_context(scene, options, context, report));
    PILEUS_TRY(frames_of(scene, options, frames));
    PILEUS_TRY(find_method(scene, method));
    PILEUS_TRY(method->check(scene, budget_of(options)));

    if (!options.show.empty()) PILEUS_TRY(find_view(scene.method, options.show, method));
    return render_frames(scene, *method, options, context, frames, sink);
}

Status plan_scene(const Scene& scene, const RenderOptions& options, bool exact, Report& report) {
    const FpModeGuard guard;
    Context context;
    Frames frames{};
    const Method* method = nullptr;
    PILEUS_TRY(frames_of(scene, options, frames));
    PILEUS_TRY(make_context(scene, options, context, report));
    PILEUS_TRY(find_method(scene, method));
    const Budget budget = budget_of(options);
    PILEUS_TRY(method->check(scene, budget));
    const std::unique_ptr<MethodRun> run = method->make();
    PILEUS_TRY(exact ? method->prepare(scene, budget, context, *run)
                     : method->outline(scene, budget, context, *run));
    method->report_plan(*run, context, report);
    return Status::ok();
}

}  // namespace pileus
