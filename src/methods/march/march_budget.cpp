// SPDX-License-Identifier: Apache-2.0
// See march_budget.h.
#include "src/methods/march/march_budget.h"

#include <algorithm>

#include "platform/clock.h"

namespace pileus {
namespace {

/// Marched pixels of the trial lie so far apart.
constexpr int kTrial = 16;
/// Fewest steps of a ray that still show a cloud.
constexpr int kFewestSteps = 16;

PixelLattice trial_lattice(const CameraParams& camera) {
    PixelLattice g = whole_lattice(camera);
    g.every = kTrial;
    g.first[0] = std::min(kTrial / 2, camera.width - 1);
    g.first[1] = std::min(kTrial / 2, camera.height - 1);
    g.width = (camera.width - g.first[0] + kTrial - 1) / kTrial;
    g.height = (camera.height - g.first[1] + kTrial - 1) / kTrial;
    return g;
}

/// Seconds of a marched pixel, by a trial whose pixels are thrown away.
Status pixel_seconds(const UpsampleInput& in, MarchPicture& picture, double& seconds) {
    const PixelLattice lattice = trial_lattice(in.camera);
    const Planes& planes = picture.planes;
    Planes few;
    PILEUS_TRY(allocate_planes(lattice.width, lattice.height, 3, !planes.opaque_depth.empty(),
                               !planes.half_depth.empty(), few));
    take_behind(lattice, in.camera.width, planes, few);
    const RaymarchTally counted = picture.tally;
    const double start = wall_seconds();
    PILEUS_TRY(in.march(lattice, few));
    seconds = (wall_seconds() - start) / (double(lattice.width) * double(lattice.height));
    picture.tally = counted;
    return Status::ok();
}

}  // namespace

Status choose_march_work(const Context& context, const FrameView& view, double start_s,
                         const UpsampleInput& in, MarchState& state) {
    MarchChoice& choice = state.choice;
    if (!(choice.seconds > 0) || choice.whole_steps == 0) return Status::ok();
    RaymarchSettings& settings = choice.settings;
    UpsampleSettings& thin = settings.thin;
    if (!choice.look) thin = choice.whole_thin;
    settings.march.steps = choice.whole_steps;
    double pixel_s = 0;
    PILEUS_TRY(pixel_seconds(in, state.picture, pixel_s));
    const double left_s = choice.seconds - (wall_seconds() - start_s);
    const double whole_s = pixel_s * double(in.camera.width) * double(in.camera.height);
    const auto takes = [&](int every) { return whole_s / (double(every) * double(every)); };
    int& every = thin.temporal > 0 ? thin.temporal : thin.scale;
    // Parts of the light have every pixel marched.
    const OutputSettings& output = view.scene.output;
    const int coarsest = output.layer_light || output.layer_order ? every : 4;
    while (every < coarsest && takes(every) > left_s) every *= 2;
    if (takes(every) > left_s) {
        const double share = std::max(left_s, 0.0) / takes(every);
        const int fewest = std::min(kFewestSteps, choice.whole_steps);
        settings.march.steps = std::max(int(share * choice.whole_steps), fewest);
    }
    // Where light comes from was chosen for all steps; with fewer the same scene might choose
    // again.
    const bool swept = settings.light.kind == RaymarchLightKind::kBuffer;
    const char* light = choice.march_light ? "march" : swept ? "buffer" : "buffer-exact";
    context.report->frame_work = {thin.temporal > 0 ? 0 : thin.scale, thin.temporal,
                                  settings.march.steps, settings.light.refresh, 0};
    context.report->light_rule = light;
    return Status::ok();
}

}  // namespace pileus
