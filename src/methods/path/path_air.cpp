// SPDX-License-Identifier: Apache-2.0
// A path tracing seen through the air: the media's light, the ground's and the sky's are dimmed
// each by its own way. in: planes of the film, before and after a filter -> out: planes as the
// camera sees them. docs/atmosphere.md, "In front of things"
#include "kernels_cpu/core/profile.h"
#include "src/methods/path/path_state.h"
#include "src/picture/air_view.h"
#include "src/picture/filter/regression.h"

namespace pileus {
namespace {

bool has_air(const FrameView& view, const PathState& state) {
    return view.lighting.air && state.camera.flux == 0;
}

bool is_solid(const Planes& p, std::size_t i) {
    return !p.opaque_depth.empty() && p.opaque_depth[i] < kNothingSolid;
}

}  // namespace

Status path_straight(const Context& context, const FrameView& view, const PathState& state,
                     Buffer<float>& straight) {
    if (!has_air(view, state)) return Status::ok();
    const Planes& p = state.planes;
    const std::size_t pixels = state.film.pixels();
    Buffer<float> sky;
    if (path_filters(state.filter)) PILEUS_TRY(path_sky_behind(context, view, state, sky));
    PILEUS_TRY(allocate(arrays::film_means(3, pixels), straight));
    for (std::size_t at = 0; at < 3 * pixels; ++at) {
        const std::size_t i = at % pixels;
        // A filter keeps to the sky as it is known, the film has its own samples of it.
        if (!sky.empty() && !is_solid(p, i))
            straight[at] = p.transmittance[i] * sky[at];
        else
            straight[at] =
                p.colour[at] - float(film_mean(state.film, kPathCloud, int(at / pixels), i));
    }
    return Status::ok();
}

Status path_air(const Context& context, const FrameView& view, PathState& state,
                Buffer<float>& straight) {
    if (!kAtmosphere || straight.empty()) return Status::ok();
    Planes& p = state.planes;
    const std::size_t pixels = state.film.pixels();
    Buffer<float> dimmed;
    PILEUS_TRY(allocate(arrays::film_means(3, pixels), dimmed));
    for (std::size_t at = 0; at < 3 * pixels; ++at) {
        dimmed[at] = 1;
        // Rays through one pixel may see ground and sky: what has no medium in it is no medium's.
        if (p.transmittance[at % pixels] == 1) straight[at] = p.colour[at];
        p.colour[at] -= straight[at];
    }
    PILEUS_TRY(run_air(context, view.scene, view.world.medium, view.lighting, state.camera,
                       view.environment, p,
                       {p.colour.data(), straight.data(), dimmed.data(), true}));
    if (!p.cloud.empty()) {
        for (std::size_t at = 0; at < 3 * pixels; ++at) p.cloud[at] = p.colour[at];
    }
    for (std::size_t at = 0; at < p.error.size(); ++at) p.error[at] *= dimmed[at];
    for (std::size_t at = 0; at < 3 * pixels; ++at) p.colour[at] += straight[at];
    return Status::ok();
}

}  // namespace pileus
