// SPDX-License-Identifier: Apache-2.0
// See deliver.h.
#include "src/session/deliver.h"

#include "src/io/images/image_file.h"
#include "src/session/run_context.h"

namespace pileus {

void finish_clocks(const RunStart& start, Report& report) {
    report.clocks.total_s = wall_seconds() - start.wall_s;
    report.clocks.cpu_s = cpu_seconds() - start.cpu_s;
    take_clocks(report.clocks);
}

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
    add("budgetUsed", report.budget_used);
    add("show", report.show);
    // The user has: such a picture is sound, but cannot be made again where part of a pass counts.
    if (report.interrupted) add("interrupted", "true");
    // A time has chosen them: `--set` with these makes the picture again.
    if (report.budget.find("seconds") != std::string::npos && report.frame_work.steps > 0) {
        const FrameWork& work = report.frame_work;
        add("steps", std::to_string(work.steps));
        add("scale", std::to_string(work.scale));
        add("temporal", std::to_string(work.temporal));
        add("light", report.light_rule);
    }
    if (report.photons.generations > 0)
        add("generations", std::to_string(report.photons.generations));
    if (report.paths.samples_per_pixel > 0)
        add("samplesPerPixel", std::to_string(report.paths.samples_per_pixel));
    for (std::size_t i = 0; i < report.overrides.size(); ++i)
        add("override." + std::to_string(i), report.overrides[i]);
}

void take_hash(const Context& context, const Image& image, Report& report) {
    const StageClock clock(context, "hash");
    report.hash = pixel_hash(image);
    report.digests.emplace_back("image", report.hash);
}

Status deliver(const Scene& scene, const RunStart& start, int frame, const FrameSink& sink,
               Image& image, Report& report) {
    image.pixel_hash = report.hash;
    image.scene_text = scene.text;
    report.frame = frame;
    note_origin(report, image);
    finish_clocks(start, report);
    return sink(frame, image, report);
}

}  // namespace pileus
