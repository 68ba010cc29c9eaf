// SPDX-License-Identifier: Apache-2.0
// See methods.h.
#include "src/methods/methods.h"

#include "kernels_cpu/core/profile.h"
#include "src/base/angles.h"

namespace pileus {

Status open_run(const Method& method, const Scene& scene, const Budget& budget,
                const Context& context, bool exact, std::shared_ptr<const World> world,
                MethodRun& run) {
    run.scene = &scene;
    run.budget = budget;
    std::shared_ptr<World> own;
    // A flight brings the world that was packed.
    if (!kFlight && world == nullptr) {
        own = std::make_shared<World>();
        PILEUS_TRY(outline_world(scene, method.world, context, *own));
        world = own;
    }
    run.world = std::move(world);
    PILEUS_TRY(outline_surroundings(scene, context, *run.world, run.around));
    PILEUS_TRY(method.outline(context, run));
    if (!exact) return Status::ok();
    if (!kFlight && own != nullptr) PILEUS_TRY(load_world(scene, context, *own));
    PILEUS_TRY(load_surroundings(scene, context, run.around));
    return method.prepare(context, run);
}

SunTurn turn_of_sun(const Scene& scene, int slices, std::int64_t number, const SunDirection& sun) {
    SunTurn turn{slices, number, sun, nullptr};
    if (!kFilms || !moves_sun(scene)) return turn;
    const Scene* from = &scene;
    turn.sun_of = [from](std::int64_t frame) {
        const SunPlace at = sun_at(*from, frame > 0 ? int(frame) : 0);
        const Double3 to = towards_deg(at.azimuth_deg, at.elevation_deg);
        return SunDirection{float(to[0]), float(to[1]), float(to[2])};
    };
    return turn;
}

}  // namespace pileus
