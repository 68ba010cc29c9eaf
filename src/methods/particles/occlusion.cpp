// SPDX-License-Identifier: Apache-2.0
// Layers of files: `occlusion`, how much of the sky what a pixel shows of the particles does not
// see; data of whole rays.
// in: an octree -> out: numbers for each pixel.
// docs/particles.md, "Occlusion"; Monette and Whitehead 2014, 5.3.
#include <utility>

#include "kernels_cpu/core/math.h"
#include "platform/threads.h"
#include "src/methods/particles/light_places.h"
#include "src/methods/particles/sun_tiles.h"
#include "src/picture/whole_rays.h"

namespace pileus {
namespace {

/// [channel][ball]: the share of the sky that each ball's middle sees past all balls, in the first
/// channel alone. With a ground the sky is the upper half.
Status sky_seen(const Context& context, const FrameView& view, const ParticlesState& state,
                Buffer<float>& seen) {
    const std::size_t count = state.tree.balls.size();
    PILEUS_TRY(allocate(arrays::particle_around(count), seen));
    Buffer<float> depth;
    PILEUS_TRY(allocate(arrays::particle_depths(count, 1), depth));
    const int first = view.lighting.ground.present ? kSkyParts / 2 : 0;
    const float share = 1.0f / float(kSkyParts - first);
    // What is deeper lets nothing through.
    constexpr float kMax = 88;
    for (int part = first; part < kSkyParts; ++part) {
        SunTiles tiles;
        PILEUS_TRY(
            make_sun_tiles(context, state.tree, casts_of(state), sky_direction(part), tiles));
        PILEUS_TRY(sun_depths(context, tiles, {0, 0, 0}, kMax, depth.data(), part - first,
                              kSkyParts - first));
        parallel_each(context.threads, count,
                      [&](std::size_t i) { seen[i] += share * exp_(-depth[i]); });
    }
    return Status::ok();
}

}  // namespace

Status show_occlusion(const Context& context, const FrameView& view, ParticlesState& state) {
    const StageClock clock(context, "occlusion layer");
    const std::size_t pixels = state.planes.transmittance.size();
    PILEUS_TRY(
        allocate_once(arrays::picture_planes(1, pixels, Stage::kDisplay), state.planes.occlusion));
    for (float& v : state.planes.occlusion.span()) v = 0;
    if (state.tree.balls.empty()) return Status::ok();
    Buffer<float> around;
    PILEUS_TRY(sky_seen(context, view, state, around));
    // A second picture whose only light is the share seen, behind the same solids.
    Planes own;
    PILEUS_TRY(allocate(arrays::picture_planes(1, pixels, Stage::kDisplay), own.transmittance));
    PILEUS_TRY(allocate(arrays::picture_planes(3, pixels, Stage::kDisplay), own.colour));
    std::swap(own, state.planes);
    state.planes.opaque_depth.swap(own.opaque_depth);
    state.around_balls.swap(around);
    const Status drawn = draw_particles(context, view, lit_from_around(view, state), state);
    state.around_balls.swap(around);
    state.planes.opaque_depth.swap(own.opaque_depth);
    std::swap(own, state.planes);
    PILEUS_TRY(drawn);
    for (std::size_t i = 0; i < pixels; ++i) {
        const float alpha = 1 - own.transmittance[i];
        if (!(alpha > 0)) continue;
        const float hidden = 1 - own.colour[i] / alpha;
        state.planes.occlusion[i] = hidden > 0 ? (hidden < 1 ? hidden : 1.0f) : 0.0f;
    }
    return Status::ok();
}

Status follow_particles(const Context& context, const FrameView& view, ParticlesState& state) {
    const double stop = state.settings.stop_below;
    if (state.tree.balls.empty()) return Status::ok();
    const auto march = [&](Planes& rays) {
        state.settings.stop_below = 0;
        std::swap(rays, state.planes);
        const Status drawn = draw_particles(context, view, lit_from_around(view, state), state);
        std::swap(rays, state.planes);
        state.settings.stop_below = stop;
        return drawn;
    };
    return follow_rays(view.scene.output, {stop, false}, march, state.planes);
}

}  // namespace pileus
