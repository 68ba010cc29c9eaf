// SPDX-License-Identifier: Apache-2.0
// A frame of a film by a method that is a class: lights, view, picture, image.
// in: an open session, a frame -> out: an image with the scene's layers; the report's part of it.
// docs/architecture.md, "Methods"
#include "src/picture/finish_frame.h"
#include "src/session/session.h"
#include "src/world/camera/view.h"

namespace pileus {

Status Session::film_frame(int frame, Image& image) {
    MethodRun& run = *run_;
    const World& world = *run.world;
    run.lighting = light_of(scene_, run.sun_of(frame), world, run.environment);
    const FrameView view = view_of(run, frame);
    // A film tells of no change: methods see by themselves that the sun has moved.
    PILEUS_TRY(made_.method->set_view(context_, view, {}));
    Planes* planes = nullptr;
    PILEUS_TRY(made_.method->render(context_, view, {}, planes));
    report_.digests = run.digests;
    const CameraParams camera =
        make_camera(scene_.camera, orbit_at(scene_, frame), world.medium.low_m);
    return finish_frame(context_, scene_.output, world, run.environment.depth, camera,
                        made_.report->finished(), *planes, image, report_);
}

}  // namespace pileus
