// SPDX-License-Identifier: Apache-2.0
// See run_context.h.
#include "src/session/run_context.h"

#include "platform/clock.h"
#include "src/run/find_kernels.h"
#include "src/scene/read_scene.h"

namespace pileus {

Status refuse_clouds(const Scene& scene) {
    if (!scene.clouds.present()) return Status::ok();
    return at_key(scene, "clouds.kind",
                  Status::bad_input("many clouds are drawn by pileus render alone, allowed: that, "
                                    "or pileus_sky_create"));
}

Status make_context(const Scene& scene, const RenderOptions& options, Context& context,
                    Report& report) {
    PILEUS_TRY(refuse_clouds(scene));
    context.kernels = options.kernels;
    if (context.kernels == nullptr) PILEUS_TRY(find_kernels(options.isa, context.kernels));
    PILEUS_TRY(test_kernels(*context.kernels));
    if (options.threads < 0 || options.threads > kMaxThreads)
        return Status::bad_input("--threads: out of range, " + std::to_string(options.threads) +
                                 ", allowed: 0 (all) to " + std::to_string(kMaxThreads));
    context.threads = options.threads > 0 ? options.threads : hardware_threads();
    context.report = &report;
    context.progress = options.progress;
    context.interrupted = options.interrupted;
    context.holding = options.holding;
    context.limits = options.limits;
    context.part = options.part;
    context.sharing = options.sharing;
    context.frames = std::uint64_t(options.last_frame) - std::uint64_t(options.first_frame) + 1;
    note_head(scene, options, context, report);
    return Status::ok();
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

std::string budget_used(const MethodReport& method, const Budget& given, int frame,
                        const Report& report) {
    // Part of a pass or of a generation is no whole number of them.
    if (report.paths.ahead_samples > 0 || (report.interrupted && report.photons.generations > 0))
        return "";
    Budget used;
    used.steps = given.steps;
    method.budget_used(frame, report, used);
    return budget_text(used);
}

void take_clocks(Clocks& clocks) {
    clocks.peak_bytes = peak_memory_bytes();
    for (const StageTime& s : clocks.stages)
        if (s.name == "photons" || s.name == "paths") {
            clocks.tracing_wall_s = s.wall_s;
            clocks.tracing_cpu_s = s.cpu_s;
        }
}

}  // namespace pileus
