// SPDX-License-Identifier: Apache-2.0
// See render_views.h and follow.h.
#include "src/session/render_views.h"

#include "platform/fp_mode.h"
#include "src/methods/collectors/views/views.h"
#include "src/session/follow.h"

namespace pileus {
namespace {

Status only_collectors(const char* what, const Scene& scene) {
    if (scene.method == "collectors") return Status::ok();
    return Status::bad_input(std::string(what) + ": not for method " + scene.method +
                             ", allowed: method.name = \"collectors\"");
}

}  // namespace

Status render_views(const Scene& scene, const RenderOptions& options, const Context& context,
                    const Frames& frames, const FrameSink& sink) {
    PILEUS_TRY(only_collectors("--show", scene));
    const RunStart start;
    const Budget budget = budget_of(options);
    Report& report = *context.report;
    View view{};
    PILEUS_TRY(find_view(options.show, view));
    ViewRun run;
    PILEUS_TRY(
        collectors_view_prepare(scene, view, collectors_photons(scene, budget), context, run));
    for (int frame = frames.first; frame <= frames.last && !report.interrupted; ++frame) {
        const FrameStep step{frame, frame == frames.first, frame == frames.last};
        if (view == View::kIllumination)
            PILEUS_TRY(collectors_light(budget, step, context, run.run));
        Image image;
        report.digests.clear();
        PILEUS_TRY(collectors_view_show(orbit_at(scene, frame), context, run, image));
        take_hash(image, report);
        collectors_view_report(run, context, report);
        PILEUS_TRY(deliver(scene, start, frame, sink, image, report));
    }
    return Status::ok();
}

Status follow(const Scene& scene, const RenderOptions& options, int light, std::uint32_t number,
              PhotonWay& way) {
    const FpModeGuard guard;
    Report report;
    Context context;
    PILEUS_TRY(only_collectors("follow", scene));
    PILEUS_TRY(make_context(scene, options, context, report));
    ViewRun view;
    PILEUS_TRY(collectors_view_prepare(
        scene, View::kPhotons, collectors_photons(scene, budget_of(options)), context, view));
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

}  // namespace pileus
