// SPDX-License-Identifier: Apache-2.0
// See scenery.h.
#include "src/methods/scenery.h"

#include "src/picture/air_view.h"

namespace pileus {

Status open_method(const MethodRow& row, const MadeMethod& made, const Context& context, bool exact,
                   const Image* sky, std::shared_ptr<const World> world, Scenery& scenery,
                   Plan& plan) {
    const Scene& scene = *scenery.scene;
    std::shared_ptr<World> own;
    HostMedia given;
    // A flight brings the world that was packed.
    if (world == nullptr) {
        if (scenery.media != nullptr) given = *scenery.media;
        given.weather = scenery.weather.get();
        PILEUS_TRY(outline_own_world(scene, row.world, given, context, own));
        world = own;
    }
    scenery.world = std::move(world);
    PILEUS_TRY(check_all_frames(scenery));
    PILEUS_TRY(outline_environment(scene, context, *scenery.world, sky, scenery.environment));
    scenery.light(0);
    PILEUS_TRY(make_plan(made, context, scenery, plan));
    if (!exact) return Status::ok();
    if (own != nullptr) PILEUS_TRY(load_world(scene, given, context, *own));
    PILEUS_TRY(load_environment(scene, context, scenery.environment));
    // The values may show that there is no medium.
    scenery.light(0);
    PILEUS_TRY(made.method->prepare(context, scenery.view(0)));
    return make_plan(made, context, scenery, plan);
}

Status show_air(const Context& context, const FrameView& view, Planes& planes) {
    return show_air(context, view.scene, view.world.medium, view.lighting, view.camera,
                    view.environment, planes);
}

}  // namespace pileus
