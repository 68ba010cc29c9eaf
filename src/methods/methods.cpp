// SPDX-License-Identifier: Apache-2.0
// See methods.h.
#include "src/methods/methods.h"

#include "kernels_cpu/core/profile.h"
#include "src/base/angles.h"
#include "src/methods/placed_media.h"
#include "src/methods/recipe_method.h"
#include "src/scene/above_ground.h"
#include "src/scene/read_scene.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

constexpr int kFramesAsked = 10000;

/// Of longer films some frames here; each is looked at again before it is drawn. Worlds of a
/// sequence differ from frame to frame.
Status check_all_frames(const MethodRun& run) {
    const Scene& scene = *run.scene;
    if (run.place_at && has_sequence(scene)) return Status::ok();
    const int frames = run.place_at ? scene.animation.frames : 1;
    const int step = 1 + (frames - 1) / kFramesAsked;
    // Scenes that keys move are at their first frame by now.
    Ground rest = scene.ground;
    if (run.place_at) rest.altitude_m += placement_at(scene, 0).offset_m.z;
    for (int frame = 0; frame < frames; frame += step)
        PILEUS_TRY(check_placed_media(run, rest, frame));
    return Status::ok();
}

void make_light(const MethodRow& row, MethodRun& run) {
    if (row.recipe == nullptr) light_frame(0, run);
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

Status make_plan(const MethodRow& row, const MadeMethod& made, const Context& context,
                 MethodRun& run) {
    const FrameView view = view_of(run, 0);
    if (kPlans && row.recipe == nullptr) run.plan = Plan{};
    PILEUS_TRY(made.method->plan(context, view, run.plan));
    if (!kPlans || row.recipe != nullptr) return Status::ok();
    made.report->explain(context, view, run.plan);
    const std::string& file = run.scene->file;
    PILEUS_TRY(check_limit(context.limits, LimitId::kMemory, run.plan.memory.peak(), file));
    return check_work(run.plan.work, context.limits, file);
}

Status check_placed_media(const MethodRun& run, const Ground& rest, int frame) {
    const World& world = *run.world;
    // What a flight has was looked at when it was packed.
    if (kFlight || world.media == 0) return Status::ok();
    const Scene& scene = *run.scene;
    const double moved = run.place_at ? placement_at(scene, frame).offset_m.z : 0;
    const double low = world.medium.low_m.z + moved;
    if (!is_below_ground(rest, low, moved)) return Status::ok();
    const std::string fault = below_ground_text(rest, low, moved);
    if (!run.place_at) return at_key(scene, "medium", Status::bad_input(fault));
    return at_key(scene, "animation.keys",
                  Status::bad_input("frame " + std::to_string(frame) + ", the media are " + fault));
}

Status open_run(const MethodRow& row, const MadeMethod& made, const Scene& scene,
                const Budget& budget, const Context& context, bool exact,
                std::shared_ptr<const World> world, MethodRun& run) {
    run.scene = &scene;
    if (run.rest == nullptr) run.rest = &scene;
    run.budget = budget;
    std::shared_ptr<World> own;
    // A flight brings the world that was packed.
    if (!kFlight && world == nullptr) {
        own = std::make_shared<World>();
        PILEUS_TRY(outline_world(scene, row.world, context, *own));
        world = own;
    }
    run.world = std::move(world);
    if (!kFlight) PILEUS_TRY(check_all_frames(run));
    PILEUS_TRY(outline_environment(scene, context, *run.world, run.sky, run.environment));
    make_light(row, run);
    PILEUS_TRY(make_plan(row, made, context, run));
    if (!exact) return Status::ok();
    if (!kFlight && own != nullptr) PILEUS_TRY(load_world(scene, context, *own));
    PILEUS_TRY(load_environment(scene, context, run.environment));
    // The values may show that there is no medium.
    make_light(row, run);
    PILEUS_TRY(made.method->prepare(context, view_of(run, 0)));
    if (kPlans && row.recipe == nullptr && context.digests)
        made.report->digest(view_of(run, 0), run.digests);
    return make_plan(row, made, context, run);
}

Status open_run(const Recipe& recipe, const Scene& scene, const Budget& budget,
                const Context& context, bool exact, std::shared_ptr<const World> world,
                MethodRun& run) {
    const MadeMethod made = method_of(recipe, run);
    return open_run(row_of(recipe), made, scene, budget, context, exact, std::move(world), run);
}

SunTurn turn_of_sun(const MethodRun& run, int slices, std::int64_t number,
                    const SunDirection& sun) {
    return turn_of(*run.scene, run.rest, {slices, number, sun, nullptr});
}

SunTurn turn_of_sun(const FrameView& view, int slices, std::int64_t number) {
    return turn_of(view.scene, view.rest, {slices, number, view.lighting.to_sun, nullptr});
}

}  // namespace pileus
