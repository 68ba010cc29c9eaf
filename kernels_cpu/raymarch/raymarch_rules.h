// SPDX-License-Identifier: Apache-2.0
// A panel of the integral along a ray: its samples, their weights by one of five rules.
// in: a field, light, a stretch of a ray -> out: light, transmittance and depth added to a sum.
// Palenik 2016, 3.1 and chapter 4; docs/raymarch.md, "Integrators".
#pragma once
#include "kernels_cpu/core/meshes.h"
#include "kernels_cpu/display/pixel_light.h"
#include "kernels_cpu/raymarch/raymarch_light.h"
#include "kernels_cpu/raymarch/raymarch_steps.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// What does not change along a ray.
template <class T>
struct RayLight {
    T phase[kMaxMedia];                ///< of each medium towards the camera
    T turn;                            ///< 1 - cos of the angle by which sunlight is scattered
    T octave[kMaxMedia][kMaxOctaves];  ///< phase functions of the octaves from 1 on
};
template <class T>
PILEUS_FN RayLight<T> ray_light(const RaymarchParams& k, const Vec<T>& d) {
    RayLight<T> r{};
    const Vec<T> to_sun{all<T>(k.to_sun[0]), all<T>(k.to_sun[1]), all<T>(k.to_sun[2])};
    r.turn = one_minus_cosine(to_sun, d);
    const T most = most_density(k.camera, d);
    for (int i = 0; i < kMaxMedia && i < k.media; ++i) {
        r.phase[i] = min_(phase_density(k.phase[i], r.turn) * k.phase_scale[i], most);
        for (int n = 1; n < k.light.octaves.count; ++n)
            r.octave[i][n] = min_(hg_density(all<T>(k.light.octave_g[i][n]), r.turn), most);
    }
    return r;
}

/// What solids leave of the sun at a place.
template <class T>
PILEUS_FN T sun_seen(const RaymarchParams& k, const RaymarchBuffers& b, const Vec<T>& place) {
    const T all_of_it = all<T>(1.0f);
    if (!dimmed_by_meshes(b.visibility)) return all_of_it;
    const bool wraps = k.medium.periodic != 0;
    const Vec<T> node = node_position(k.visibility, reduced(k.medium, place));
    // A layer to the horizon goes on beyond its nodes: nothing is known of shadows there.
    const std::int32_t* n = k.visibility.size;
    const auto known =
        (node.x >= 0.0f) & (node.x <= float(n[0])) & (node.y >= 0.0f) & (node.y <= float(n[1]));
    return select(known, interpolate(b.visibility, corners(node, n, wraps)), all_of_it);
}

/// One sample: density, and the radiance that a full mean free path of it would show.
template <class T>
struct RaySample {
    T density, source[3], share;  ///< share: of the light without phase functions, at most 1
};
template <class T, class Field>
PILEUS_FN RaySample<T> take_sample(const RaymarchParams& k, const RaymarchBuffers& b,
                                   const Field& field, const RayLight<T>& r, const Vec<T>& place,
                                   T width, M_of<T> wanted, std::int64_t* counts) {
    RaySample<T> s{};
    counts[kCountSamples] += count_bits(bits_of(wanted));
    s.density = select(wanted, field_density(field, place, width), T{});
    const auto dense = s.density > 0.0f;
    if (!any(dense)) return s;
    for (int c = 0; c < 3; ++c) s.source[c] = all<T>(k.ambient[c]);
    const bool emits = k.ambient[0] > 0 || k.ambient[1] > 0 || k.ambient[2] > 0;
    if (emits) s.share = all<T>(1.0f);
    if (k.sunlit == 0 && k.sky.sets == 0) return s;
    T light[3] = {}, glow[3] = {}, more[kMaxOctaves] = {}, tau{};
    if (k.sunlit != 0)
        tau =
            sunlight_at(k, b.optical_depth, field, place, s.density, dense, r.turn, counts, light);
    T factor = sun_seen(k, b, place);
    if (dimmed_by_meshes(b.visibility))
        for (int c = 0; c < k.light.channels; ++c) light[c] = light[c] * factor;
    const bool octaves = k.sunlit != 0 && k.light.octaves.count > 1;
    T brightest = max_(light[0], max_(light[1], light[2]));
    if (octaves) {
        if (k.light.powder != kPowderNone)
            factor = factor * powder_factor(k.light, tau, s.density * k.medium.sigma, r.turn);
        brightest = octave_light(k.light.octaves, tau, brightest, factor, more);
    }
    s.share = max_(s.share, brightest);
    if (k.sky.sets > 0) s.share = max_(s.share, skylight_at(k, b.sky, field, place, glow));
    field_shares(field, place, s.density, [&](int i, T share) {
        const T weight = share * r.phase[i];
        for (int c = 0; c < 3; ++c) {
            if (octaves) absorb_octaves(k.light.octaves, k.octave_depths, i, c, tau, factor, more);
            const T sun = weight * light[k.light.channels == 1 ? 0 : c];
            s.source[c] = s.source[c] + sun * k.sun_source[i][c];
            for (int n = 1; octaves && n < k.light.octaves.count; ++n)
                s.source[c] =
                    s.source[c] + share * r.octave[i][n] * more[n] * k.octave_source[i][n][c];
            if (k.sky.sets > 0) s.source[c] = s.source[c] + share * glow[c] * k.albedo[i][c];
        }
    });
    return s;
}

/// What a ray has gathered.
template <class T>
struct RaySum {
    T transmittance, depth, half, colour[3], share;
};

/// Adds a sample with a weight; what it weighs is light of the medium between 0 and 1.
template <class T>
PILEUS_FN void add_sample(const RaySample<T>& s, T weight, RaySum<T>& sum) {
    for (int c = 0; c < 3; ++c) sum.colour[c] = sum.colour[c] + weight * s.source[c];
    sum.share = sum.share + weight * s.share;
}

/// Goes on through an optical depth between two distances: transmittance, and where it is a half.
template <class T>
PILEUS_FN void pass_depth(T optical, T from, T to, RaySum<T>& sum) {
    const T left = sum.transmittance * exp_(T{} - optical);
    const auto crosses = (sum.transmittance > 0.5f) & (left <= 0.5f);
    if (any(crosses)) {
        const T share =
            log_(max_(sum.transmittance, all<T>(1e-30f)) * 2.0f) / max_(optical, all<T>(1e-30f));
        sum.half = select(crosses, from + share * (to - from), sum.half);
    }
    sum.depth = sum.depth + optical;
    sum.transmittance = left;
}

/// Weight of sample j of a panel of `n` steps under a rule, its steps as the unit.
PILEUS_FN float panel_weight(std::int32_t rule, int j) {
    if (rule == kRuleTrapezoid) return 0.5f;
    if (rule == kRuleSimpson) return j == 1 ? 4.0f / 3.0f : 1.0f / 3.0f;
    return j == 0 || j == 3 ? 0.375f : 1.125f;
}

/// One ray on its way. Samples are taken at distances from `origin`; `shift` more from the camera.
template <class T, class Field>
struct RayMarch {
    const RaymarchParams& k;
    const RaymarchBuffers& b;
    const Field& field;
    Vec<T> origin, direction;
    T shift;
    RayLight<T> light;
    std::int64_t* counts;
};
template <class T, class Field>
PILEUS_FN RaySample<T> sample_at(const RayMarch<T, Field>& r, T at, T width, M_of<T> wanted) {
    const Vec<T> p{r.origin.x + r.direction.x * at, r.origin.y + r.direction.y * at,
                   r.origin.z + r.direction.z * at};
    const T filter = max_(width, pixel_width(r.k.camera, r.k.step, r.shift + at));
    return take_sample(r.k, r.b, r.field, r.light, p, filter, wanted, r.counts);
}

/// A panel from `from` to `to` with one sample: Riemann's from its start, the closed form's from
/// its middle.
template <class T, class Field>
PILEUS_FN void add_single(const RayMarch<T, Field>& r, T from, T to, M_of<T> dense,
                          RaySum<T>& sum) {
    const bool closed = r.k.rule == kRuleClosed;
    const T width = to - from;
    const RaySample<T> s = sample_at(r, closed ? from + 0.5f * width : from, width, dense);
    const T optical = s.density * (r.k.medium.sigma * width);
    if (!any(optical > 0.0f)) return;
    const T before = sum.transmittance;
    pass_depth(optical, r.shift + from, r.shift + to, sum);
    add_sample(s, closed ? before * one_minus_exp(optical) : sum.transmittance * optical, sum);
}

/// A panel whose ends are samples too; `last` is that of its start, and becomes that of its end.
/// Transmittance between samples by the trapezoid rule, (4.9) and (4.10).
template <class T, class Field>
PILEUS_FN void add_panel(const RayMarch<T, Field>& r, T from, T to, M_of<T> dense,
                         RaySample<T>& last, RaySum<T>& sum) {
    const int steps = rule_steps(r.k.rule);
    const T width = (to - from) * (1.0f / float(steps)), sigma = r.k.medium.sigma * width;
    add_sample(
        last,
        select(dense, panel_weight(r.k.rule, 0) * last.density * sigma * sum.transmittance, T{}),
        sum);
    for (int j = 1; j <= steps; ++j) {
        const T a = from + float(j - 1) * width, e = j == steps ? to : from + float(j) * width;
        const RaySample<T> s = sample_at(r, e, width, dense);
        const T optical = 0.5f * (last.density + s.density) * sigma;
        pass_depth(select(dense, optical, T{}), r.shift + a, r.shift + e, sum);
        const T weight = panel_weight(r.k.rule, j) * s.density * sigma * sum.transmittance;
        add_sample(s, weight, sum);
        last = s;
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
