// SPDX-License-Identifier: Apache-2.0
// See ordinate_own.h.
#include "src/picture/ordinates/ordinate_own.h"

#include <algorithm>

#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/display/march_ray.h"
#include "kernels_cpu/light/lamp_sphere.h"
#include "kernels_cpu/media/medium.h"
#include "platform/threads.h"
#include "src/picture/ordinates/ordinate_medium.h"

namespace pileus {
namespace {

/// Irradiance of a lamp of strength 1 on a place, and the way towards it.
LampSight<float> sight_of(const LampParams& lamp, const Vec<float>& place) {
    if (!(lamp.radius > 0)) return see_lamp(lamp, place);
    const LampCone<float> cone = lamp_cone(lamp, place);
    return {cone.way, cone.distance, cone.share};
}

/// Adds moments of a lamp's light on what lies in a node: its mean over samples of the density.
void add_lamp(const OrdinateNodes& nodes, const NodeSamples& samples, const LampNodes& lamps,
              std::size_t which, float sigma, float rest, float light, std::size_t filled,
              float (&moments)[kOrdinateMoments]) {
    const LampParams& lamp = lamps.lamps[which];
    const float* depths = lamps.optical_depth.data() + which * std::size_t(node_count(lamps.grid));
    // A lamp within a sample's cell lights it from no nearer than a quarter of its edge.
    const float* cells = samples.fine.per_metre;
    const float least = 0.25f / std::max(cells[0], std::max(cells[1], cells[2]));
    float mass = 0, sum[kOrdinateMoments] = {};
    each_held_sample(nodes, samples, filled, [&](std::size_t s, std::size_t at) {
        const float density = nodes.samples[at];
        mass += density;
        const Vec<float> place = sample_place(samples, s);
        const LampSight<float> sight = sight_of(lamp, place);
        if (!(density > 0 && sight.share > 0)) return;
        const float depth =
            rest * std::max(interpolate(depths, node_corners(node_position(lamps.grid, place),
                                                             lamps.grid.size)),
                            0.0f);
        float share = sight.share;
        if (lamp.parallel == 0 && sight.distance < least)
            share *= sight.distance * sight.distance / (least * least);
        const float way[3] = {sight.way.x, sight.way.y, sight.way.z};
        const float kept = light_in_sample(SampleWay(samples, way), rest * sigma * density, depth);
        float harmonic[kOrdinateMoments];
        sh_eval<4>(-way[0], -way[1], -way[2], harmonic);
        const float lit = density * share * light * kept;
        for (int m = 0; m < kOrdinateMoments; ++m) sum[m] += lit * harmonic[m];
    });
    for (int m = 0; m < kOrdinateMoments && mass > 0; ++m) moments[m] += sum[m] / mass;
}

}  // namespace

Status own_light(const Context& context, const Medium& medium, const OrdinateNodes& nodes,
                 const OrdinateAsk& ask, const OrdinateSet& set, Buffer<float>& work,
                 const float*& fixed) {
    fixed = nullptr;
    if (set.own == 0) return Status::ok();
    const std::size_t filled = nodes.filled.size(), count = nodes.density.size();
    PILEUS_TRY(allocate_once(arrays::ordinate_own(filled, true), work));
    float harmonic[kOrdinates][kOrdinateMoments];
    set_ordinate_harmonics(harmonic);
    const NodeSamples samples = node_samples(nodes.grid, nodes.within);
    const auto channel = std::size_t(set.own == kLampStrength ? 0 : set.own - 1);
    parallel_each(context.threads, filled, [&](std::size_t n) {
        const auto i = std::size_t(nodes.filled[n]);
        const float rest = ordinate_rest(nodes, nodes.parts, set.channel, i);
        float moments[kOrdinateMoments] = {}, kept[4] = {}, emitted = 0, out[kOrdinates];
        each_lamp(ask, [&](std::size_t l) {
            const LampParams& lamp = ask.lamps->lamps[l];
            const float light = set.own == kLampStrength ? lamp.strength : lamp.light[channel];
            if (light > 0)
                add_lamp(nodes, samples, *ask.lamps, l, medium.sigma, rest, light, n, moments);
        });
        for (std::size_t m = 0; m < std::size_t(nodes.media); ++m) {
            const float part = nodes.media == 1 ? 1.0f : nodes.parts[m * count + i];
            const OrdinateOptics& optics = nodes.optics[m][set.channel];
            const float counts = part * optics.rest / std::max(rest, 1e-6f);
            for (int l = 0; l < 4; ++l) kept[l] += counts * ordinate_scatter(optics, l);
            if (ask.emission)
                emitted += part * medium.optics[m].emission[channel] / std::max(rest, 1e-6f);
        }
        scatter_moments(moments, kept, harmonic, kept[0] * moments[0] / harmonic[0][0], out);
        for (std::size_t j = 0; j < kOrdinates; ++j) work[j * filled + n] = out[j] + emitted;
    });
    fixed = work.data();
    return Status::ok();
}

}  // namespace pileus
