// SPDX-License-Identifier: Apache-2.0
// The most that a marched picture takes.
// in: the work of a frame, settings, sizes -> out: pixels, rays, samples.
// docs/realtime.md, "Maximum cost of a frame"
#include "src/methods/march/march_state.h"
#include "src/methods/most_units.h"
#include "src/world/world.h"

namespace pileus {
namespace {

/// Of one ray. A rule of integration takes up to 3 steps as one; the first of these may begin
/// before the medium, the last one end behind it, and the ray's start is looked up, too.
Status ray_samples(const FrameView& view, const FrameWork& work, const MarchState& state,
                   std::uint64_t& samples) {
    constexpr std::uint64_t kRule = 2 * 3;
    const Medium& medium = marched_medium(view, state);
    if (state.choice.settings.march.spacing == RaymarchSpacing::kVoxel || medium.grid.constant) {
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
Status sun_samples(const FrameView& view, const MarchState& state, std::uint64_t& samples) {
    samples = 0;
    const bool lit = view.scene.sun.present || view.scene.atmosphere.present;
    if (!lit || !state.choice.march_light || state.choice.sky_nodes) return Status::ok();
    PILEUS_TRY(most_grid_samples(view.world.medium, samples));
    const std::uint64_t steps = std::uint64_t(state.choice.settings.light.steps);
    if (steps > 0 && !view.world.medium.grid.constant) samples = steps;
    return Status::ok();
}

}  // namespace

Status march_most_units(const FrameView& view, const FrameWork& work, const MarchState& state,
                        FrameUnits& out) {
    const Medium& medium = view.world.medium;
    const Lighting& lighting = view.lighting;
    most_pixels(work, view.scene.camera.resolution, lighting.opaque(), state.picture.upsample, out);
    if (state.choice.settings.march.steps == 0 || medium.sigma <= 0) return Status::ok();
    std::uint64_t own = 0, sun = 0;
    PILEUS_TRY(ray_samples(view, work, state, own));
    PILEUS_TRY(sun_samples(view, state, sun));
    out.samples = out.rays * own * (1 + sun);
    return add_lamp_samples(medium, lighting, out);
}

}  // namespace pileus
