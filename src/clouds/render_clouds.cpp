// SPDX-License-Identifier: Apache-2.0
// See render_clouds.h.
#include "src/clouds/render_clouds.h"

#include <algorithm>

#include "platform/fp_mode.h"
#include "platform/threads.h"
#include "src/clouds/scene_clouds.h"
#include "src/clouds/weather_clouds.h"
#include "src/picture/finish_frame.h"
#include "src/plan/crop.h"
#include "src/session/deliver.h"
#include "src/session/run_context.h"
#include "src/session/warnings.h"
#include "src/world/atmosphere/atmosphere.h"
#include "src/world/camera/view.h"

namespace pileus {
namespace {

/// Of the kinds and layers, each once.
std::string methods_of(const CloudCounts& clouds) {
    std::vector<std::string> all;
    for (const auto* list : {&clouds.kinds, &clouds.layers})
        for (const CloudKindCount& part : *list)
            if (std::find(all.begin(), all.end(), part.method) == all.end())
                all.push_back(part.method);
    std::string text;
    for (const std::string& method : all) text += (text.empty() ? "" : ", ") + method;
    return text;
}

/// What is set in the sky's session from frame to frame.
class SkyAnimation {
public:
    explicit SkyAnimation(const Scene& scene) : scene_(scene), rest_(scene) {
        place_sun(rest_.atmosphere, 0, rest_.sun);
    }

    Status set(int frame, Session& sky) const {
        if (!scene_.animation.present) return sky.set_frame(frame);
        PILEUS_TRY(sky.set_frame(frame));
        Camera camera = camera_at(rest_.animation, rest_.camera, frame);
        const double turned = orbit_at(rest_, frame);
        if (turned != 0) camera.position_m = orbit(camera.position_m, camera.target_m, turned);
        PILEUS_TRY(sky.set_camera(camera));
        if (moves_time(scene_)) return sky.set_hours(hours_at(scene_, frame), scene_.sun);
        Sun sun = rest_.sun;
        if (moves_sun(scene_)) {
            const SunPlace at = sun_at(rest_, rest_.sun, frame);
            sun.azimuth_deg = at.azimuth_deg;
            sun.elevation_deg = at.elevation_deg;
        }
        return sky.set_sun(sun);
    }

private:
    const Scene& scene_;
    Scene rest_;  ///< with a sun by its date, as it is but for keys
};

void tell_picture(const CloudStats& stats, CloudCounts& told) {
    told.visible = stats.visible;
    told.marched = stats.marched;
    told.shown = stats.visible - stats.marched;
    told.captured = stats.captured;
    told.lit = stats.lit;
    told.marched_pixels = stats.marched_pixels;
    told.captured_pixels = stats.captured_pixels;
    told.worst_px = stats.worst_px;
}

Status draw_image(const Scene& scene, Session& sky, Clouds& clouds, Image& image, Report& report) {
    const Planes* planes = nullptr;
    PILEUS_TRY(clouds.draw(scene.output.layer_depth, planes));
    const StageClock clock(sky.context(), "layers");
    const Double3& low = sky.world().medium.low_m;
    return finish_layers(scene.output, make_camera(sky.camera(), 0, low), low, *planes, image,
                         report);
}

}  // namespace

Status render_clouds(const Scene& described, const RenderOptions& options, const FrameSink& sink) {
    // A picture of all of the view, which is cut.
    Scene scene = described;
    std::vector<std::string> notes, unknown;
    PILEUS_TRY(apply_weather(scene, &notes, &unknown));
    const Shown shown = take_window(scene);
    scene.crop = {};
    const FpModeGuard guard;
    ThreadPool threads;
    const PoolGuard lent(threads);
    const RunStart start;
    Frames frames{};
    PILEUS_TRY(frames_of(scene, options, frames));
    Session sky;
    Clouds clouds;
    Report& report = sky.report();
    PILEUS_TRY(open_sky(scene, options, sky));
    const Context& context = sky.context();
    note_head(scene, options, context, report);
    PILEUS_TRY(open_scene_clouds(scene, options, sky, clouds, report.clouds));
    report.method = methods_of(report.clouds);
    explain_crop(described, report.plan);
    report.clouds.notes = notes;
    if (!scene.solids.empty())
        report.plan.leave_out("shadows of solids on clouds",
                              "a sky's clouds know one another alone");
    const SkyAnimation animation(scene);
    const int run = film_run(scene), first = frames.first;
    for (int frame = film_begin(scene, first); frame <= frames.last; ++frame) {
        const RunStart frame_start;
        Image image;
        PILEUS_TRY(animation.set(frame, sky));
        if (run > 0 && frame % run == 0) PILEUS_TRY(clouds.restart());
        PILEUS_TRY(draw_image(scene, sky, clouds, image, report));
        if (frame < first) continue;
        PILEUS_TRY(cut_image(sky.camera(), shown, image));
        report.digests.clear();
        take_hash(context, image, report);
        tell_picture(clouds.stats(), report.clouds);
        find_warnings(scene, image, report);
        for (const std::string& group : unknown) report.warnings.push_back(group);
        report.clocks.frame_wall_s = wall_seconds() - frame_start.wall_s;
        report.clocks.frame_cpu_s = cpu_seconds() - frame_start.cpu_s;
        if (options.holding) options.holding(true);
        PILEUS_TRY(deliver(scene, start, frame, sink, image, report));
        if (options.holding) options.holding(false);
    }
    return Status::ok();
}

}  // namespace pileus
