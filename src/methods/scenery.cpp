// SPDX-License-Identifier: Apache-2.0
// See scenery.h.
#include "src/methods/scenery.h"

#include "kernels_cpu/core/profile.h"
#include "src/base/angles.h"
#include "src/scene/above_ground.h"
#include "src/scene/read_scene.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

constexpr int kFramesAsked = 10000;

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

/// With suns of other frames, where they have others.
SunTurn turn_of(const Scene& scene, const FrameState* rest, SunTurn turn) {
    if (!kFilms || rest == nullptr || !moves_sun(scene)) return turn;
    turn.sun_of = [at = &scene, rest](std::int64_t frame) {
        const SunPlace sun = sun_at(*at, rest->sun, frame > 0 ? int(frame) : 0);
        const Double3 to = towards_deg(sun.azimuth_deg, sun.elevation_deg);
        return SunDirection{float(to[0]), float(to[1]), float(to[2])};
    };
    return turn;
}

}  // namespace

Status make_plan(const MadeMethod& made, const Context& context, Scenery& scenery, Plan& plan) {
    const FrameView view = scenery.view(0);
    if (kPlans) plan = Plan{};
    PILEUS_TRY(made.method->plan(context, view, plan));
    if (!kPlans) return Status::ok();
    made.report->explain(context, view, plan);
    const std::string& file = scenery.scene->file;
    PILEUS_TRY(check_limit(context.limits, LimitId::kMemory, plan.memory.peak(), file));
    return check_work(plan.work, context.limits, file);
}

Status check_placed_media(const Scenery& scenery, const Ground& rest, int frame) {
    const World& world = *scenery.world;
    // What a flight has was looked at when it was packed.
    if (kFlight || world.media == 0) return Status::ok();
    const Scene& scene = *scenery.scene;
    const double moved = scenery.keyed ? placement_at(scene, frame).offset_m.z : 0;
    const double low = world.medium.low_m.z + moved;
    if (!is_below_ground(rest, low, moved)) return Status::ok();
    const std::string fault = below_ground_text(rest, low, moved);
    if (!scenery.keyed) return at_key(scene, "medium", Status::bad_input(fault));
    return at_key(scene, "animation.keys",
                  Status::bad_input("frame " + std::to_string(frame) + ", the media are " + fault));
}

Status open_method(const MethodRow& row, const MadeMethod& made, const Context& context, bool exact,
                   const Image* sky, std::shared_ptr<const World> world, Scenery& scenery,
                   Plan& plan) {
    const Scene& scene = *scenery.scene;
    std::shared_ptr<World> own;
    // A flight brings the world that was packed.
    if (!kFlight && world == nullptr) {
        own = std::make_shared<World>();
        PILEUS_TRY(outline_world(scene, row.world, context, *own));
        world = own;
    }
    scenery.world = std::move(world);
    if (!kFlight) PILEUS_TRY(check_all_frames(scenery));
    PILEUS_TRY(outline_environment(scene, context, *scenery.world, sky, scenery.environment));
    scenery.light(0);
    PILEUS_TRY(make_plan(made, context, scenery, plan));
    if (!exact) return Status::ok();
    if (!kFlight && own != nullptr) PILEUS_TRY(load_world(scene, context, *own));
    PILEUS_TRY(load_environment(scene, context, scenery.environment));
    // The values may show that there is no medium.
    scenery.light(0);
    PILEUS_TRY(made.method->prepare(context, scenery.view(0)));
    return make_plan(made, context, scenery, plan);
}

SunTurn turn_of_sun(const FrameView& view, int slices, std::int64_t turn) {
    return turn_of(view.scene, view.rest, {slices, turn, view.lighting.to_sun, nullptr});
}

}  // namespace pileus
