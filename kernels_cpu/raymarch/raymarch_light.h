// SPDX-License-Identifier: Apache-2.0
// Sunlight that reaches a place in a field: by a march towards the sun, or from nodes.
// in: a place, optical depths on nodes or the field itself -> out: the share of the sun's light.
// Palenik 2016, (3.4), 3.2 and 3.3; docs/raymarch.md, "Light".
#pragma once
#include "kernels_cpu/raymarch/raymarch_field.h"
#include "kernels_cpu/raymarch/raymarch_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Optical depth towards the sun, and what of it forward scattering takes off, per channel.
template <class T>
struct SunDepths {
    T tau, kept[3];
};

/// What forward scattering takes off a step of depth `optical`, where it differs along the way.
template <class T, class Field>
PILEUS_FN void add_kept(const RaymarchParams& k, const Field& field, const Vec<T>& place, T density,
                        T optical, SunDepths<T>& sum) {
    if (k.light.forward == 0 || k.media <= 1) return;
    field_shares(field, place, density, [&](int i, T share) {
        for (int c = 0; c < k.light.channels; ++c)
            sum.kept[c] = sum.kept[c] + optical * share * k.light.kept[i][c];
    });
}

/// The way to the sun, step by step; `wanted` lanes alone. Of so many steps those of [begin, end).
template <class T, class Field>
PILEUS_FN SunDepths<T> march_to_sun(const RaymarchParams& k, const Field& field,
                                    const Vec<T>& place, M_of<T> wanted, std::int64_t* counts,
                                    std::int32_t begin, std::int32_t end) {
    const RaymarchLight& light = k.light;
    const Vec<T> d{all<T>(k.to_sun[0]), all<T>(k.to_sun[1]), all<T>(k.to_sun[2])};
    const T leave = field_clip(field, Ray<T>{place, d}).leave;
    // All steps alike and to the end, or so many that grow.
    const bool whole = light.steps == 0;
    const float most = k.medium.periodic != 0 ? 1.0f / kMaxPeriodicSteps : kMinStep;
    T width = max_(all<T>(light.first_m), leave * most);
    if (!whole) width = light.first_m > 0 ? all<T>(light.first_m) : leave / light.series;
    SunDepths<T> sum{};
    T at{}, n{};
    for (std::int32_t turn = 0; turn < begin; ++turn) at = at + width, width = width * light.growth;
    Vec<T> from = place;
    auto alive = wanted & (at < leave);
    const bool leaps = whole && light.turns == 0;
    for (std::int32_t turn = begin; any(alive) && (whole || turn < end); ++turn) {
        T real = max_(min_(width, leave - at), T{});
        if constexpr (Field::kHasVoxels) {
            if (leaps) {
                const Vec<T> start{place.x + d.x * at, place.y + d.y * at, place.z + d.z * at};
                real = min_(real, field_voxel(field, start, d, least_way(width, leave)));
            }
        }
        const T half = 0.5f * real, middle = at + half;
        Vec<T> p{place.x + d.x * middle, place.y + d.y * middle, place.z + d.z * middle};
        auto within = alive;
        if (light.turns > 0) {
            // A fuzzy way: each step has a direction of its own, and may lead out of the medium.
            const float* way = light.direction[turn % light.turns];
            p = {from.x + way[0] * half, from.y + way[1] * half, from.z + way[2] * half};
            from = {from.x + way[0] * real, from.y + way[1] * real, from.z + way[2] * real};
            within = within & field_holds(field, p);
        }
        Block<T> ahead{all<T>(1.0f), T{}};
        if (Field::kBoundsAreCheap || leaps) ahead = field_ahead(field, p, d, real);
        const auto dense = within & (ahead.bound > 0.0f);
        if (any(dense)) {
            counts[kCountLightSamples] += count_bits(bits_of(dense));
            const T density = select(dense, field_density(field, p, real), T{});
            const T optical = density * (k.medium.sigma * real);
            sum.tau = sum.tau + optical;
            add_kept(k, field, p, density, optical, sum);
        }
        T skipped = all<T>(1.0f);
        // Even steps leap to the last one whose middle lies in an empty block.
        if (leaps) {
            const T steps = to_float(to_int(min_(ahead.rest / width, all<T>(1e6f))));
            skipped = select(dense, skipped, max_(steps, skipped));
        }
        n = n + skipped;
        if (Field::kHasVoxels && leaps)
            at = at + select(dense, real, max_(half + ahead.rest, real));
        else
            at = whole ? n * width : at + width;
        if (!whole) width = width * light.growth;
        alive = alive & (at < leave) & (sum.tau < 60.0f);  // e^-60 is nothing
    }
    return sum;
}

template <class T, class Field>
PILEUS_FN SunDepths<T> field_sunlight(const RaymarchParams& k, const Field& field,
                                      const Vec<T>& place, M_of<T> wanted, std::int64_t* counts) {
    if constexpr (Field::kHasSunNodes) {
        if (field.light != nullptr) {
            const std::int32_t near = field.light->near_steps;
            SunDepths<T> depth{};
            if (near > 0) depth = march_to_sun(k, field, place, wanted, counts, 0, near);
            depth.tau = depth.tau + field_sun_depth(field, place);
            return depth;
        }
    }
    return march_to_sun(k, field, place, wanted, counts, 0, k.light.steps);
}

/// Powder: less light where little lies before the sun; `turn` is 1 - cos of the scattering angle,
/// `extinction` that of the place, 1/m.
template <class T>
PILEUS_FN T powder_factor(const RaymarchLight& light, T tau, T extinction, T turn) {
    const T depth = light.powder == kPowderLocal ? extinction : tau;
    const T p = one_minus_exp(min_(depth * light.powder_strength, all<T>(87.0f)));
    if (light.powder >= kPowderSimple) return max_(1.0f - light.powder_share * (1.0f - p), T{});
    if (light.powder != kPowderDirectional) return p;
    // Looking along the sunlight, turn is 2; cos(theta) of (3.15) is turn - 1.
    return 1.0f - 0.5f * turn * (1.0f - p);
}

/// Skylight at a place, scattered alike in all directions; returns its share, at most 1.
template <class T, class Field>
PILEUS_FN T skylight_at(const RaymarchParams& k, const float* nodes, const Field& field,
                        const Vec<T>& place, T (&out)[3]) {
    const RaymarchSky& sky = k.sky;
    const std::int64_t count =
        std::int64_t(sky.nodes.size[0]) * sky.nodes.size[1] * sky.nodes.size[2];
    const Corners<T> at =
        node_corners(node_position(sky.nodes, field_in_box(field, k.medium, place)), sky.nodes.size,
                     k.medium.periodic != 0);
    T share{};
    for (std::int32_t s = 0; s < sky.sets; ++s) {
        const T seen = max_(interpolate(nodes + s * count, at), T{});
        share = max_(share, seen);
        for (int c = 0; c < 3; ++c) out[c] = out[c] + seen * sky.colour[s][c];
    }
    return share;
}

/// Shares of the light in octave n of the way's light, from octave 1 on, where its depth is `tau`;
/// returns the mean of all octaves with `first`, by their shares.
template <class T>
PILEUS_FN T octave_light(const Octaves& o, T tau, T first, T factor, T (&light)[kMaxOctaves]) {
    float share = 1.0f, all_shares = 1.0f, thinner = 1.0f;
    T sum = first;
    for (int n = 1; n < o.count; ++n) {
        share = share * o.share, thinner = thinner * o.extinction;
        light[n] = exp_(T{} - tau * thinner) * factor;
        sum = sum + share * light[n];
        all_shares = all_shares + share;
    }
    return sum * (1.0f / all_shares);
}

/// What absorption leaves of the octaves of medium i in channel c, where it is known for that one.
template <class T>
PILEUS_FN void absorb_octaves(const Octaves& o, const OctaveDepths& depths, int i, int c, T tau,
                              T factor, T (&light)[kMaxOctaves]) {
    if (c >= depths.channels) return;
    for (int n = 1; n < o.count; ++n) light[n] = exp_(T{} - tau * depths.thinner[i][n][c]) * factor;
}

/// Share of the sun's light at a place, per channel (light.channels of them); returns the optical
/// depth of the way.
template <class T, class Field>
PILEUS_FN T sunlight_at(const RaymarchParams& k, const float* optical_depth, const Field& field,
                        const Vec<T>& place, T density, M_of<T> wanted, T turn,
                        std::int64_t* counts, T (&out)[3]) {
    SunDepths<T> depth{};
    if (k.light.march != 0) {
        depth = field_sunlight(k, field, place, wanted, counts);
    } else {
        const Vec<T> q = reduced(k.medium, place);
        const Corners<T> at = node_corners(node_position(k.light.nodes, q), k.light.nodes.size,
                                           k.medium.periodic != 0);
        depth.tau = max_(interpolate(optical_depth, at), T{});
        // Nodes hold one depth: the media here stand for those on the way.
        add_kept(k, field, place, density, depth.tau, depth);
    }
    for (int c = 0; c < k.light.channels; ++c) {
        T left = depth.tau;
        if (k.light.forward != 0)
            left = k.media > 1 ? max_(depth.tau - depth.kept[c], T{})
                               : depth.tau * (1.0f - k.light.kept[0][c]);
        out[c] = k.light.powder == kPowderAlone ? all<T>(1.0f) : exp_(T{} - left);
        if (k.light.powder != kPowderNone)
            out[c] = out[c] * powder_factor(k.light, depth.tau, density * k.medium.sigma, turn);
    }
    return depth.tau;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
