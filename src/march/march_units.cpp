// SPDX-License-Identifier: Apache-2.0
// The most that a marched picture takes.
// in: the work of a frame, a run -> out: pixels, rays, samples.
// docs/realtime.md, "What a frame takes at the most"
#include "src/march/march_run.h"
#include "src/methods/most_units.h"

namespace pileus {
namespace {

/// Of one ray. A rule of integration takes up to 3 steps as one; the first of these may begin
/// before the medium, the last one end behind it, and the ray's start is looked up, too.
Status ray_samples(const FrameWork& work, const RaymarchRun& run, std::uint64_t& samples) {
    constexpr std::uint64_t kRule = 2 * 3;
    const Medium& medium = marched_medium(run);
    if (run.settings.spacing == RaymarchSpacing::kVoxel || medium.grid.constant) {
        PILEUS_TRY(most_grid_samples(medium, samples));
        // Those and its own steps end a step.
        if (medium.grid.constant) samples += std::uint64_t(work.steps);
    } else {
        samples = std::uint64_t(work.steps);
    }
    samples += kRule;
    return Status::ok();
}

/// Of one way to the sun.
Status sun_samples(const RaymarchRun& run, std::uint64_t& samples) {
    samples = 0;
    const bool lit = run.scene->sun.present || run.scene->atmosphere.present;
    if (!lit || !run.march_light || run.sky_nodes) return Status::ok();
    PILEUS_TRY(most_grid_samples(run.world->medium, samples));
    const std::uint64_t steps = std::uint64_t(run.settings.light_steps);
    if (steps > 0 && !run.world->medium.grid.constant) samples = steps;
    return Status::ok();
}

}  // namespace

Status march_most_units(const FrameWork& work, const MethodRun& method_run, FrameUnits& out) {
    const RaymarchRun& run = static_cast<const RaymarchRun&>(method_run);
    most_pixels(work, run.scene->camera.resolution, run.lighting.opaque(), run.upsample, out);
    if (run.settings.steps == 0 || run.world->medium.sigma <= 0) return Status::ok();
    std::uint64_t own = 0, sun = 0;
    PILEUS_TRY(ray_samples(work, run, own));
    PILEUS_TRY(sun_samples(run, sun));
    out.samples = out.rays * own * (1 + sun);
    return add_lamp_samples(run.world->medium, run.lighting, out);
}

}  // namespace pileus
