// SPDX-License-Identifier: Apache-2.0
// See render.h.
#include "src/api/render.h"

#include "platform/clock.h"
#include "platform/fp_mode.h"
#include "src/api/follow.h"
#include "src/io/image_file.h"
#include "src/methods/collectors.h"
#include "src/methods/collectors_views.h"

namespace pileus {
namespace {

constexpr int kMostThreads = 1024;

Status make_context(const Scene& scene, const RenderOptions& options, Context& context,
                    Report& report) {
    context.kernels = kernel_table(options.isa.empty() ? nullptr : options.isa.c_str());
    if (context.kernels == nullptr) {
        std::string names;
        for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i)
            names += (i > 0 ? ", " : "") + std::string(table->name);
        return Status::bad_input("--isa: no such instruction set here, \"" + options.isa +
                                 "\", allowed: " + names);
    }
    if (context.kernels->self_test() != expected_self_test())
        return Status{Code::kCheckFailed,
                      "self test: the kernels give other bits than they must on this machine"};
    if (options.threads < 0 || options.threads > kMostThreads)
        return Status::bad_input("--threads: out of range, " + std::to_string(options.threads) +
                                 ", allowed: 0 (all) to " + std::to_string(kMostThreads));
    context.threads = options.threads > 0 ? options.threads : hardware_threads();
    context.report = &report;
    context.progress = options.progress;
    context.limits = options.limits;
    context.frames = std::uint64_t(options.last_frame - options.first_frame + 1);
    report.version = kVersion;
    report.scene = scene.file;
    report.method = scene.method;
    report.seed = scene.seed;
    report.isa = context.kernels->name;
    report.threads = context.threads;
    return Status::ok();
}

std::int64_t photons_of(const Scene& scene, const RenderOptions& options) {
    return options.budget_photons >= 0 ? options.budget_photons : scene.collectors.photons;
}

struct Frames {
    int first, last, total;
};

double share_of(int frame, int total) { return total > 1 ? double(frame) / (total - 1) : 0.0; }

double lerp(const std::array<double, 2>& range, double share) {
    return range[0] + (range[1] - range[0]) * share;
}

double sun_at(const Scene& scene, int frame) {
    const Animation& a = scene.animation;
    return a.present && a.moves_sun ? lerp(a.sun_elevation_deg, share_of(frame, a.frames))
                                    : scene.sun.elevation_deg;
}
double orbit_at(const Scene& scene, int frame) {
    const Animation& a = scene.animation;
    return a.present && a.moves_camera ? lerp(a.camera_orbit_deg, share_of(frame, a.frames)) : 0.0;
}

Status shoot(const RenderOptions& options, const Context& context, CollectorsRun& run,
             std::uint64_t count) {
    const StageClock clock(context, "photons");
    const double start = wall_seconds();
    for (std::uint64_t g = 0; g < count; ++g) {
        PILEUS_TRY(collectors_shoot(context, run));
        context.tell("photons", double(g + 1) / double(count));
        // Time only chooses a whole number of generations, which the report records.
        if (options.budget_seconds > 0 && wall_seconds() - start >= options.budget_seconds) break;
    }
    return Status::ok();
}

/// Frame f of an animation has the ring of generations f .. f + p - 1, whatever frames were asked
/// for, so that a part of an animation repeats the whole's bits.
Status light_frame(const Scene& scene, const RenderOptions& options, const Context& context,
                   CollectorsRun& run, int frame, bool first) {
    if (!first) {
        PILEUS_TRY(collectors_set_sun(sun_at(scene, frame), context, run));
        return shoot(options, context, run, 1);
    }
    if (!scene.animation.present) return shoot(options, context, run, run.generations);
    run.next_generation = std::uint64_t(frame);
    const std::uint64_t last = run.next_generation + run.generations;
    while (run.next_generation < last) {
        // Generation g >= p was shot for frame g - p + 1; those before it under frame 0's sun.
        const std::uint64_t g = run.next_generation;
        const int shown = g < run.generations ? 0 : int(g - run.generations + 1);
        PILEUS_TRY(collectors_set_sun(sun_at(scene, shown), context, run));
        PILEUS_TRY(shoot(options, context, run, 1));
    }
    return Status::ok();
}

struct Stopwatch {
    double wall = wall_seconds(), cpu = cpu_seconds();
};

void finish_report(const Stopwatch& watch, Report& report) {
    report.total_s = wall_seconds() - watch.wall;
    report.cpu_s = cpu_seconds() - watch.cpu;
    report.peak_bytes = peak_memory_bytes();
    for (const StageTime& s : report.stages)
        if (s.name == "photons") {
            report.tracing_wall_s = s.wall_s;
            report.tracing_cpu_s = s.cpu_s;
        }
}

Status frames_of(const Scene& scene, const RenderOptions& options, Frames& frames) {
    frames = {options.first_frame, options.last_frame,
              scene.animation.present ? scene.animation.frames : 1};
    if (frames.first >= 0 && frames.first <= frames.last && frames.last < frames.total)
        return Status::ok();
    return Status::bad_input("--frames: " + std::to_string(frames.first) + "-" +
                             std::to_string(frames.last) + ", allowed: within 0-" +
                             std::to_string(frames.total - 1));
}

/// Completes a frame's picture and report, and hands both over.
Status deliver(const Scene& scene, const Stopwatch& watch, int frame, const FrameSink& sink,
               Image& image, Report& report) {
    image.pixel_hash = report.hash;
    image.scene_text = scene.text;
    finish_report(watch, report);
    return sink(frame, image, report);
}

/// Names the picture by its bits before anything else is written about it.
void take_hash(const Image& image, Report& report) {
    report.hash = pixel_hash(image);
    report.digests.emplace_back("image", report.hash);
}

Status render_pictures(const Scene& scene, const RenderOptions& options, const Context& context,
                       const Frames& frames, const FrameSink& sink) {
    const Stopwatch watch;
    Report& report = *context.report;
    CollectorsRun run;
    PILEUS_TRY(collectors_prepare(scene, photons_of(scene, options), context, run));
    collectors_report_plan(run, context, report);
    for (int frame = frames.first; frame <= frames.last; ++frame) {
        PILEUS_TRY(light_frame(scene, options, context, run, frame, frame == frames.first));
        if (frame == frames.last) collectors_end_tracing(run);
        Image image;
        report.digests.clear();
        PILEUS_TRY(collectors_show(orbit_at(scene, frame), context, run, image));
        take_hash(image, report);
        collectors_report(run, report);
        PILEUS_TRY(deliver(scene, watch, frame, sink, image, report));
    }
    return Status::ok();
}

Status render_views(const Scene& scene, const RenderOptions& options, const Context& context,
                    const Frames& frames, const FrameSink& sink) {
    const Stopwatch watch;
    Report& report = *context.report;
    View view{};
    PILEUS_TRY(find_view(options.show, view));
    ViewRun run;
    PILEUS_TRY(collectors_view_prepare(scene, view, photons_of(scene, options), context, run));
    for (int frame = frames.first; frame <= frames.last; ++frame) {
        if (view == View::kIllumination)
            PILEUS_TRY(
                light_frame(run.scene, options, context, run.run, frame, frame == frames.first));
        Image image;
        report.digests.clear();
        PILEUS_TRY(collectors_view_show(orbit_at(scene, frame), context, run, image));
        take_hash(image, report);
        collectors_view_report(run, context, report);
        PILEUS_TRY(deliver(scene, watch, frame, sink, image, report));
    }
    return Status::ok();
}

}  // namespace

Status render(const Scene& scene, const RenderOptions& options, const FrameSink& sink) {
    const FpModeGuard guard;
    Report report;
    Context context;
    Frames frames{};
    PILEUS_TRY(make_context(scene, options, context, report));
    PILEUS_TRY(frames_of(scene, options, frames));

    return options.show.empty() ? render_pictures(scene, options, context, frames, sink)
                                : render_views(scene, options, context, frames, sink);
}

Status follow(const Scene& scene, const RenderOptions& options, int light, std::uint32_t number,
              PhotonWay& way) {
    const FpModeGuard guard;
    Report report;
    Context context;
    PILEUS_TRY(make_context(scene, options, context, report));
    ViewRun view;
    PILEUS_TRY(
        collectors_view_prepare(scene, View::kPhotons, photons_of(scene, options), context, view));
    const std::vector<Light>& lights = view.run.lighting.lights;
    if (light < 0 || std::size_t(light) >= lights.size())
        return Status::bad_input("--light: no such light, " + std::to_string(light) +
                                 ", allowed: less than " + std::to_string(lights.size()));
    const Light& chosen = lights[std::size_t(light)];
    if (number >= chosen.photons)
        return Status::bad_input("--photon: not in the first generation of the " + chosen.name +
                                 ", " + std::to_string(number) + ", allowed: less than " +
                                 std::to_string(chosen.photons));
    way.light = chosen.name;
    follow_photon(collectors_trace_input(context, view.run), chosen, number, kMostWayPoints,
                  way.points);
    for (PathPoint& p : way.points)
        for (std::size_t a = 0; a < 3; ++a)
            p.at_m[a] = float(double(p.at_m[a]) + view.run.medium.low_m[a]);
    return Status::ok();
}

Status plan_scene(const Scene& scene, const RenderOptions& options, bool exact, Report& report) {
    const FpModeGuard guard;
    Context context;
    Frames frames{};
    PILEUS_TRY(frames_of(scene, options, frames));
    PILEUS_TRY(make_context(scene, options, context, report));
    CollectorsRun run;
    PILEUS_TRY(exact ? collectors_prepare(scene, photons_of(scene, options), context, run)
                     : collectors_outline(scene, photons_of(scene, options), context, run));
    collectors_report_plan(run, context, report);
    return Status::ok();
}

}  // namespace pileus
