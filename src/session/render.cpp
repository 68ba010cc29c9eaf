// SPDX-License-Identifier: Apache-2.0
// See render.h. The walk through an animation, frame by frame.
#include "src/session/render.h"

#include "platform/fp_mode.h"
#include "platform/threads.h"
#include "src/methods/registry.h"
#include "src/picture/background.h"
#include "src/picture/finish_frame.h"
#include "src/picture/march_view.h"
#include "src/plan/crop.h"
#include "src/run/work_share.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/volume_format.h"
#include "src/session/deliver.h"
#include "src/session/run_context.h"
#include "src/session/session.h"
#include "src/session/verify.h"
#include "src/session/warnings.h"
#include "src/world/camera/places.h"
#include "src/world/camera/view.h"
#include "src/world/majorant/majorants.h"

namespace pileus {
namespace {

/// What files of weather data had that was no water, grids that was no density, and particles
/// that no grid holds.
void count_water(const Scene& scene, const World& world, Report& report) {
    bool weather = false, grid = false, particles = false;
    for (const MediumSettings& medium : scene.media) {
        const VolumeFormat* format = volume_format_named(medium.source.format);
        weather = weather || (format != nullptr && format->is_weather);
        particles = particles || (format != nullptr && format->is_particles);
        grid = grid || (format != nullptr && !format->is_weather && !format->is_particles);
    }
    if (weather) {
        report.counters.emplace_back("water_missing", world.medium.volume.missing);
        report.counters.emplace_back("water_negative", world.medium.volume.clamped);
        report.counters.emplace_back("columns_missing", world.medium.volume.blank);
        report.counters.emplace_back("fractions_capped", world.medium.volume.capped);
    } else if (grid) {
        report.counters.emplace_back("density_negative", world.medium.volume.clamped);
    }
    if (particles) report.counters.emplace_back("particles_uncoloured", world.medium.volume.plain);
}

Status show_shadow(const Scene& scene, const Session& session, int frame, Image& image) {
    const Context& context = session.context();
    const Medium& medium = session.world().medium;
    Majorants majorants;
    PILEUS_TRY(make_majorants(medium, false, context, majorants));
    return add_shadow(
        context, make_medium_view(medium, majorants),
        make_camera(session.scenery().scene->camera, orbit_at(scene, frame), medium.low_m),
        session.scenery().lighting, image);
}

/// Whether frames have skies of their own.
bool has_moving_sky(const Scene& scene) {
    return scene.atmosphere.present && (moves_sun(scene) || moves_time(scene));
}

/// Each frame of a sequence, or of clouds in a wind, is a world of its own.
bool has_worlds(const Scene& scene) { return has_sequence(scene) || moves_wind(scene); }

/// Frames that share a world, which may be given.
Status render_frames(const Scene& scene, const Shown& shown, const RunStart& start,
                     const RenderOptions& options, const Frames& frames,
                     const std::shared_ptr<const World>& world, const FrameSink& sink) {
    const int first = frames.first;
    const FrameState opened = opened_at(scene, first);
    Session session;
    Status ready = session.open_film(scene, opened, options, true, world);
    Report& report = session.report();
    if (ready) explain_crop(scene, report.plan);
    Verifier verifier;
    const bool verifies = options.verify > 0 && options.show.empty();
    if (ready && verifies)
        ready = verifier.open(scene, opened, std::uint64_t(options.verify), session.context(),
                              session.scenery().world);
    if (options.sharing != nullptr && !options.sharing->all_ready(bool(ready))) return ready;
    PILEUS_TRY(ready);
    const int run = film_run(scene), begin = film_begin(scene, first);
    for (int frame = begin; frame <= frames.last && !report.interrupted; ++frame) {
        const RunStart frame_start;
        Image image;
        const bool anew = run > 0 && frame % run == 0;
        PILEUS_TRY(
            draw_frame(scene, session, {frame, frame == begin, frame == frames.last, anew}, image));
        if (!session.is_first() || frame < first) continue;
        session.finish_report();
        report.budget_used = budget_used(session.method_report(), options.budget, frame, report);
        if (verifies) PILEUS_TRY(verifier.check(frame, session.context(), image, shown, report));
        PILEUS_TRY(cut_image(session.camera(), shown, image));
        take_hash(session.context(), image, report);
        count_water(scene, session.world(), report);
        if (options.show.empty()) find_warnings(scene, image, report);
        if (options.show.empty())
            warn_of_light(session.world(), session.method_report().finished(), report);
        report.clocks.frame_wall_s = wall_seconds() - frame_start.wall_s;
        report.clocks.frame_cpu_s = cpu_seconds() - frame_start.cpu_s;
        if (options.holding) options.holding(true);
        // Where the picture is, in the file's coordinates.
        const Camera seen = camera_at(scene.animation, session.camera(), frame);
        for (const auto& told :
             picture_place(*session.scenery().scene, seen, orbit_at(scene, frame),
                           session.scenery().weather.get()))
            image.origin.push_back(told);
        PILEUS_TRY(deliver(scene, start, frame, sink, image, report));
        if (options.holding) options.holding(false);
    }
    return Status::ok();
}

}  // namespace

FrameState opened_at(const Scene& scene, int frame) {
    FrameState out = scene;
    out.world = world_key_at(scene, frame);
    if (!has_moving_sky(scene)) return out;
    const SunPlace sun = sun_at(scene, scene.sun, frame);
    out.sun.azimuth_deg = sun.azimuth_deg;
    out.sun.elevation_deg = sun.elevation_deg;
    out.hours_later = hours_at(scene, frame);
    return out;
}

Status add_surface_layers(const Scene& scene, const Session& session, int frame, Image& image) {
    if (scene.output.layer_reflectance)
        PILEUS_TRY(add_reflectance(session.scenery().lighting, image));
    return scene.output.layer_shadow ? show_shadow(scene, session, frame, image) : Status::ok();
}

Status draw_frame(const Scene& scene, Session& session, const FilmFrame& step, Image& image) {
    PILEUS_TRY(session.render_image(step, image));
    if (!session.is_first() || session.shows_view()) return Status::ok();
    return add_surface_layers(scene, session, step.frame, image);
}

bool frames_stand_alone(const Scene& scene) { return has_worlds(scene) || has_moving_sky(scene); }

int film_run(const Scene& scene) {
    constexpr int kFrames = 16;
    if (!scene.animation.is_film()) return 0;
    if (scene.clouds.present()) return kFrames;
    const MethodTools tools = method_tools(scene.method);
    if (frames_stand_alone(scene) || tools.film_memory == nullptr) return 0;
    return tools.film_memory(scene).pictures ? kFrames : 0;
}

int film_begin(const Scene& scene, int frame) {
    const int run = film_run(scene);
    return run > 0 ? frame - frame % run : frame;
}

Status render(const Scene& described, const RenderOptions& options, const FrameSink& sink) {
    PILEUS_TRY(check_crop(described, options.budget, !options.show.empty()));
    Scene scene = described;
    const Shown shown = take_window(scene);
    const FpModeGuard guard;
    ThreadPool threads;
    const PoolGuard lent(threads);
    const RunStart start;
    Frames frames{};
    PILEUS_TRY(frames_of(scene, options, frames));
    // A sun that moves in air has another sky in each frame.
    const bool worlds = has_worlds(scene);
    if (!frames_stand_alone(scene))
        return render_frames(scene, shown, start, options, frames, options.world, sink);
    std::shared_ptr<const World> world;
    if (!worlds && frames.last > frames.first) {
        std::shared_ptr<World> made;
        PILEUS_TRY(make_world(scene, options, made));
        if (options.digests) made->density_digest = density_digest(*made);
        world = made;
    }
    bool interrupted = false;
    const FrameSink watched = [&](int frame, Image& image, Report& report) {
        interrupted = report.interrupted;
        return sink(frame, image, report);
    };
    for (int frame = frames.first; frame <= frames.last && !interrupted; ++frame) {
        const Frames one{frame, frame, frames.total};
        PILEUS_TRY(render_frames(scene, shown, start, options, one, world, watched));
    }
    return Status::ok();
}

Status plan_scene(const Scene& described, const RenderOptions& options, bool exact,
                  Report& report) {
    PILEUS_TRY(check_crop(described, options.budget, !options.show.empty()));
    Scene scene = described;
    (void)take_window(scene);
    const FpModeGuard guard;
    ThreadPool threads;
    const PoolGuard lent(threads);
    Frames frames{};
    PILEUS_TRY(frames_of(scene, options, frames));
    Session session;
    RenderOptions planned = options;
    planned.digests = false;  // a plan tells none
    PILEUS_TRY(session.open_film(scene, opened_at(scene, frames.first), planned, exact, nullptr));
    report = session.report();
    explain_crop(scene, report.plan);
    return Status::ok();
}

}  // namespace pileus
