// SPDX-License-Identifier: Apache-2.0
// A procedural sky's density at any place: two noises blended, thresholded, shaped with height.
// in: SkyParams, box-local metres, the width of steps -> out: densities in [0, 1], their bounds.
// Palenik 2016, section 5.1 (blend, gains, parameters A and B, dimensions); docs/skies.md.
#pragma once
#include "kernels_cpu/procedural/noise.h"
#include "kernels_cpu/procedural/sky_layer.h"
#include "kernels_cpu/procedural/sky_texture.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// How much the noise is lowered at a share of the height: rounds the clouds off at both ends.
template <class T>
PILEUS_FN T sky_lift(const SkyParams& k, T share) {
    const T shape = smooth_ramp(share * k.rise) * smooth_ramp((1.0f - share) * k.fall);
    return k.rounding * (1.0f - shape);
}

/// The blended noise at a place in box-local metres, and the variance that its levels have lost.
template <class T>
PILEUS_FN NoiseValue<T> sky_noise(const SkyParams& k, const Vec<T>& p, T width) {
    NoiseValue<T> sum{};
    if (k.perlin.share != 0.0f) sum = read_noise(k.perlin, p, width);
    if (k.worley.share != 0.0f) {
        const NoiseValue<T> one = read_noise(k.worley, p, width);
        sum = {sum.value + one.value, sum.lost + one.lost};
    }
    return sum;
}

/// The ramp between the thresholds, widened by what the noise has lost: its mean stays. A smooth
/// step of half width w has the variance w^2 / 5 (docs/skies.md, "Level of detail").
template <class T>
PILEUS_FN T sky_ramp(const SkyParams& k, T value, T lost) {
    const T half = sqrt_(k.half_width * k.half_width + 5.0f * lost);
    return smooth_ramp((value - k.middle + half) / (half + half));
}

/// Density at a place in box-local metres, filtered for steps of `width`.
template <class T>
PILEUS_FN T sky_density(const SkyParams& k, const Vec<T>& local, T width) {
    const Vec<T> p = sky_world(k, local);
    const T share = (altitude(k, p) - k.low_m) * k.inverse_m;
    const auto inside = (share >= 0.0f) & (share <= 1.0f);
    if (k.empty != 0 || !any(inside)) return T{};
    const T lift = sky_lift(k, share);
    const NoiseValue<T> noise = sky_noise(k, local, width);
    const T ramp = sky_ramp(k, noise.value - lift, noise.lost);
    const T weight = k.base_weight + (1.0f - k.base_weight) * share;
    return select(inside, ramp * weight, T{});
}

/// Least lift in the band of the height around a place, and metres until a ray may leave it.
template <class T>
PILEUS_FN NoiseBound<T> lift_ahead(const SkyParams& k, const Vec<T>& p, const Vec<T>& d, T h) {
    using II = I_of<T>;
    const T bands = (h - k.low_m) * (k.inverse_m * float(kSkyBands));
    const II band = min_(max_(to_int(bands), II{}), all<II>(kSkyBands - 1));
    const T climb = d.z + k.curvature_per_m * (p.x * d.x + p.y * d.y + p.z * d.z);
    const T gap = select(climb >= 0.0f, to_float(band + 1) - bands, bands - to_float(band));
    const T height = max_(gap, T{}) * (k.height_m * (1.0f / float(kSkyBands)));
    // A bent layer steepens by less than this over a block.
    const T steep = abs_(climb) + (k.curvature_per_m > 0.0f ? 2e-3f : 1e-9f);
    return {gather(k.least_lift, band), height / steep};
}

/// Bound within blocks `raise` levels larger than they need be; `lift` as lift_ahead gives it.
template <class T>
PILEUS_FN NoiseBound<T> sky_blocks(const SkyParams& k, const Vec<T>& local, const Vec<T>& d,
                                   T width, const NoiseBound<T>& lift, std::int32_t raise) {
    NoiseBound<T> sum{T{} - lift.bound, lift.rest};
    T lost{};
    const NoiseView* const both[2] = {&k.perlin, &k.worley};
    for (const NoiseView* v : both) {
        if (v->share == 0.0f) continue;
        const NoiseBound<T> one = noise_ahead(*v, local, d, width, raise);
        sum = {sum.bound + one.bound, min_(sum.rest, one.rest)};
        lost = lost + lost_at(*v, noise_level(*v, width));
    }
    // Below the middle a wider ramp is a bound of the narrower ones; above it none is.
    const T ramp = select(sum.bound > k.middle, all<T>(1.0f), sky_ramp(k, sum.bound, lost));
    return {ramp, sum.rest};
}

/// Upper bound of sky_density near a place, and metres until it may change.
template <class T>
PILEUS_FN NoiseBound<T> sky_ahead(const SkyParams& k, const Vec<T>& local, const Vec<T>& d,
                                  T width) {
    const Vec<T> p = sky_world(k, local);
    const T h = altitude(k, p);
    const auto inside = (h >= k.low_m) & (h <= k.low_m + k.height_m);
    if (k.empty != 0) return {T{}, all<T>(1e30f)};
    if (!any(inside)) return {T{}, way_outside(k, p, d, h)};
    const NoiseBound<T> lift = lift_ahead(k, p, d, h);
    // Large blocks take rays far through clear air; near clouds small ones tell more.
    constexpr std::int32_t kRaise = 2;
    NoiseBound<T> ahead = sky_blocks(k, local, d, width, lift, kRaise);
    const auto full = ahead.bound > 0.0f;
    if (any(full & inside)) {
        const NoiseBound<T> near = sky_blocks(k, local, d, width, lift, 0);
        ahead = {select(full, near.bound, ahead.bound), select(full, near.rest, ahead.rest)};
    }
    if (!any(lnot(inside))) return ahead;
    return {select(inside, ahead.bound, T{}), select(inside, ahead.rest, way_outside(k, p, d, h))};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
