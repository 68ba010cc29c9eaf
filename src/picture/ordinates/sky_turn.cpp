// SPDX-License-Identifier: Apache-2.0
// See sky_level.h. Levels as the march reads them.
#include <algorithm>

#include "kernels_cpu/procedural/sky_layer.h"
#include "platform/threads.h"
#include "src/picture/ordinates/sky_level.h"

namespace pileus {
namespace {

// Nodes of a level that are not read: a ring, what is mixed with it, and those that it lags by.
constexpr int kRing = 2, kBeside = kRing + kMovedNodes / 2;

/// Whether each node is seen along one direction by all rays that read it.
bool seen_from_outside(const SkyParams& sky, const CameraParams& camera,
                       const SkyOrdinateSizes& sizes) {
    if (camera.orthographic != 0) return true;
    const float* at = camera.origin;
    const double height = double(altitude(sky, sky_world(sky, Vec<float>{at[0], at[1], at[2]})));
    const double edge =
        std::max({sizes.step[0], sizes.step[1], double(sky.height_m) / sizes.size[2]});
    const double margin = 2 * kNearNodes * edge;
    return height < double(sky.low_m) - margin ||
           height > double(sky.low_m) + double(sky.height_m) + margin;
}

void turn_level(const Context& context, const SkyOrdinateAsk& ask, std::size_t l, std::size_t set,
                SkyOrdinates& out) {
    const SkyLevel& level = out.levels[l];
    const std::size_t nodes = std::size_t(out.sizes.nodes()), levels = out.levels.size();
    const float* from =
        level.nodes.solution.data() + set * level.nodes.filled.size() * kOrdinateMoments;
    SkyNodeTurnParams k{};
    k.sky = *ask.sky;
    k.places = node_places(level);
    k.ring = level.nodes.ring ? 1 : 0;
    k.orthographic = ask.camera.orthographic;
    std::copy_n(k.orthographic != 0 ? ask.camera.forward : ask.camera.origin, 3, k.camera);
    const OrdinateOptics& optics = level.nodes.optics[0][level.nodes.sets[set].channel];
    for (int i = 0; i < 4; ++i) k.scatter[i] = ordinate_scatter(optics, i);
    run_host_rows(context, host_kernels(context.kernels).sky_turn_rows, k,
                  SkyNodeTurnBuffers{from, out.front.light.data() + (set * levels + l) * nodes},
                  std::uint32_t((out.sizes.size[1] - 2 * k.ring) * out.sizes.size[2]));
}

/// Moments of the finest level, for places near the camera.
void place_moments(const Context& context, SkyOrdinates& out) {
    OrdinateNodes& front = out.front;
    const OrdinateNodes& finest = out.levels.front().nodes;
    const std::size_t nodes = std::size_t(out.sizes.nodes()), filled = finest.filled.size();
    parallel_for(context.threads, std::int64_t(front.sets.size() * kOrdinateMoments),
                 [&](std::int64_t i, int) {
                     const float* own = finest.solution.data() + std::size_t(i) * filled;
                     float* into = front.near.data() + std::size_t(i) * nodes;
                     for (std::size_t n = 0; n < filled; ++n)
                         into[std::size_t(finest.filled[n])] = own[n];
                 });
}

}  // namespace

void set_levels_view(const SkyOrdinateAsk& ask, SkyOrdinates& out) {
    OrdinateLevelsView& v = out.view;
    v.count = std::int32_t(out.levels.size());
    v.wraps = out.sizes.wraps ? 1 : 0;
    for (std::size_t l = 0; l < out.levels.size(); ++l)
        for (std::size_t a = 0; a < 2; ++a) {
            const SkyLevel& level = out.levels[l];
            const double n = out.sizes.size[a], step = level.step[a];
            const double reach = std::max(1.0, 0.5 * n - kBeside) * step;
            const double first = level.low[a] + reach + kRing * step;
            const double last = level.low[a] + n * step - reach - kRing * step;
            v.low[l][a] = float(level.low[a]);
            v.per_metre[l][a] = float(1 / step);
            v.middle[l][a] = float(std::max(first, std::min(double(ask.camera.origin[a]), last)));
            v.per_reach[l][a] = float(1 / reach);
        }
}

Status turn_levels(const Context& context, const SkyOrdinateAsk& ask, SkyOrdinates& out) {
    const StageClock clock(context, "ordinates");
    OrdinateNodes& front = out.front;
    const bool held = front.has_moments;
    front.has_moments = !seen_from_outside(*ask.sky, ask.camera, out.sizes);
    front.per_near = ordinate_per_near(front.grid);
    std::uint64_t made = 0;
    for (const SkyLevel& level : out.levels) made += level.made;
    const CameraParams &was = out.camera, &is = ask.camera;
    const bool flat = is.orthographic != 0;
    const bool seen = was.orthographic == is.orthographic &&
                      std::equal(flat ? is.forward : is.origin, (flat ? is.forward : is.origin) + 3,
                                 flat ? was.forward : was.origin);
    if (front.has_moments == held && made == out.turned && seen) return Status::ok();
    const std::uint64_t nodes = out.sizes.nodes(), sets = front.sets.size();
    PILEUS_TRY(hold(arrays::ordinate_light(nodes * out.levels.size(), sets, 1), front.light));
    if (front.has_moments && (made != out.turned || !held)) {
        PILEUS_TRY(hold(arrays::ordinate_near(nodes, sets, true), front.near));
        place_moments(context, out);
    }
    for (std::size_t l = 0; l < out.levels.size(); ++l)
        for (std::size_t s = 0; s < front.sets.size(); ++s) turn_level(context, ask, l, s, out);
    out.turned = made;
    out.camera = is;
    return Status::ok();
}

}  // namespace pileus
