// SPDX-License-Identifier: Apache-2.0
// See scenery.h: what of it no flight has. Media of all frames, plans that people read, suns of
// other frames. in: a scenery, an open method -> out: one line; a plan; suns by frame.
// docs/animation.md; docs/report.md, "Plan"
#include "src/base/angles.h"
#include "src/methods/scenery.h"
#include "src/scene/above_ground.h"
#include "src/scene/read_scene.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

constexpr int kFramesAsked = 10000;

/// With suns of other frames, where they have others.
SunTurn turn_of(const Scene& scene, const FrameState* rest, SunTurn turn) {
    if (rest == nullptr || !moves_sun(scene)) return turn;
    turn.sun_of = [at = &scene, rest](std::int64_t frame) {
        const SunPlace sun = sun_at(*at, rest->sun, frame > 0 ? int(frame) : 0);
        const Double3 to = towards_deg(sun.azimuth_deg, sun.elevation_deg);
        return SunDirection{float(to[0]), float(to[1]), float(to[2])};
    };
    return turn;
}

}  // namespace

Status outline_own_world(const Scene& scene, WorldUse use, const HostMedia& given,
                         const Context& context, std::shared_ptr<World>& world) {
    world = std::make_shared<World>();
    return outline_world(scene, use, given, context, *world);
}

/// Of longer films some frames here; each is looked at again before it is drawn. Worlds of a
/// sequence differ from frame to frame.
Status check_all_frames(const Scenery& scenery) {
    const Scene& scene = *scenery.scene;
    if (scenery.keyed && has_sequence(scene)) return Status::ok();
    const int frames = scenery.keyed ? scene.animation.frames : 1;
    const int step = 1 + (frames - 1) / kFramesAsked;
    Ground rest = scene.ground;
    if (scenery.keyed) rest.altitude_m += placement_at(scene, 0).offset_m.z;
    for (int frame = 0; frame < frames; frame += step)
        PILEUS_TRY(check_placed_media(scenery, rest, frame));
    return Status::ok();
}

Status make_plan(const MadeMethod& made, const Context& context, Scenery& scenery, Plan& plan) {
    const FrameView view = scenery.view(0);
    plan = Plan{};
    PILEUS_TRY(made.method->plan(context, view, plan));
    made.report->explain(context, view, plan);
    const std::string& file = scenery.scene->file;
    PILEUS_TRY(check_limit(context.limits, LimitId::kMemory, plan.memory.peak(), file));
    return check_work(plan.work, context.limits, file);
}

Status check_placed_media(const Scenery& scenery, const Ground& rest, int frame) {
    const World& world = *scenery.world;
    if (world.media == 0) return Status::ok();
    const Scene& scene = *scenery.scene;
    const double moved = scenery.keyed ? placement_at(scene, frame).offset_m.z : 0;
    const double low = world.medium.low_m.z + moved;
    if (!is_below_ground(rest, low, moved)) return Status::ok();
    const std::string fault = below_ground_text(rest, low, moved);
    if (!scenery.keyed) return at_key(scene, "medium", Status::bad_input(fault));
    return at_key(scene, "animation.keys",
                  Status::bad_input("frame " + std::to_string(frame) + ", the media are " + fault));
}

SunTurn turn_of_sun(const FrameView& view, int slices, std::int64_t turn) {
    return turn_of(view.scene, view.rest, {slices, turn, view.lighting.to_sun, nullptr});
}

}  // namespace pileus
