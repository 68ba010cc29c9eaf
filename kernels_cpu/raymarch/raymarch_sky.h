// SPDX-License-Identifier: Apache-2.0
// A procedural sky as the field of a raymarch: evaluated where samples lie, stored nowhere.
// in: SkyParams, places in box-local metres -> out: what raymarch_field.h asks of a field.
// Palenik 2016, section 5.1; docs/skies.md, "Evaluated directly".
#pragma once
#include "kernels_cpu/procedural/sky_field.h"
#include "kernels_cpu/procedural/sky_light.h"
#include "kernels_cpu/raymarch/raymarch.h"
#include "kernels_cpu/raymarch/raymarch_sky_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

struct SkyMedium {
    static constexpr bool kBoundsAreCheap = false, kHasVoxels = false, kHasSunNodes = true;
    const SkyParams* sky;
    const SkyLightView* light;  ///< null: none
};

template <class T>
PILEUS_FN Segment<T> field_clip(const SkyMedium& f, const Ray<T>& ray) {
    const SkyParams& k = *f.sky;
    Segment<T> s = clip_to_sky(k, sky_world(k, ray.origin), ray.direction);
    if (k.boxed != 0) {
        const Segment<T> box = clip_to_box(ray.origin, ray.direction, k.extent_m);
        s.enter = max_(s.enter, box.enter);
        s.leave = max_(min_(s.leave, box.leave), s.enter);
    }
    // A level ray through a flat layer would see no end of it.
    s.leave = min_(s.leave, s.enter + k.reach_m);
    const T end = k.empty != 0 ? s.enter : s.leave;
    return {s.enter, end};
}

template <class T>
PILEUS_FN M_of<T> field_holds(const SkyMedium& f, const Vec<T>& p) {
    const SkyParams& k = *f.sky;
    const T h = altitude(k, sky_world(k, p));
    const auto layer = (h >= k.low_m) & (h <= k.low_m + k.height_m);
    if (k.boxed == 0) return layer;
    return layer & (p.x >= 0.0f) & (p.x <= k.extent_m[0]) & (p.y >= 0.0f) & (p.y <= k.extent_m[1]) &
           (p.z >= 0.0f) & (p.z <= k.extent_m[2]);
}

/// Beyond its box a layer has what it has within, mirrored at the sides, at the same altitude: not
/// the light of those clouds, but no seam and no streaks either.
template <class T>
PILEUS_FN Vec<T> field_in_box(const SkyMedium& f, const MediumView& m, const Vec<T>& p) {
    const SkyParams& k = *f.sky;
    if (k.boxed != 0) return p;
    const auto mirrored = [](T v, float edge) {
        return edge - abs_(wrap_place(v, 2.0f * edge) - edge);
    };
    return {mirrored(p.x, m.extent[0]), mirrored(p.y, m.extent[1]),
            altitude(k, sky_world(k, p)) - k.shift_m[2]};
}

template <class T>
PILEUS_FN Block<T> field_ahead(const SkyMedium& f, const Vec<T>& place, const Vec<T>& direction,
                               T width) {
    const NoiseBound<T> ahead = sky_ahead(*f.sky, place, direction, width);
    return {ahead.bound, ahead.rest};
}

template <class T>
PILEUS_FN T field_density(const SkyMedium& f, const Vec<T>& place, T width) {
    return sky_density(*f.sky, place, width);
}

template <class T>
PILEUS_FN T field_sun_depth(const SkyMedium& f, const Vec<T>& place) {
    return sky_sun_depth(*f.sky, *f.light, place);
}

template <class T, class Use>
PILEUS_FN void field_shares(const SkyMedium&, const Vec<T>&, T, Use use) {
    use(0, all<T>(1.0f));
}

/// Rows of the picture; as raymarch_rows of a grid.
template <int W>
PILEUS_FN void raymarch_sky_rows(const RaymarchSkyParams& k, const RaymarchBuffers& b,
                                 std::uint32_t begin, std::uint32_t end) {
    raymarch_blocks<W>(k.march, b, SkyMedium{&k.sky, b.sky_light}, begin, end);
}

/// A row of nodes: the steps to the sun that no sample marches by itself.
template <int W>
PILEUS_FN void sky_light_row(const RaymarchParams& k, const SkyParams& sky,
                             const SkyLightView& view, const SkyLightRow& row, std::int32_t* words,
                             std::int64_t* counts) {
    using T = F<W>;
    const SkyMedium field{&sky, nullptr};
    std::int32_t depth[(1 << kMaxSkyLightBits) + 1 + W];
    const float spacing = view.spacing_m * float(1 << row.level);
    const float share = float(row.height) * (1.0f / float(kSkyLightHeights - 1));
    for (std::int32_t i = row.first; i <= row.last; i += W) {
        const T x = to_float(iota<I<W>>() + i) * spacing;
        const Vec<T> p = sky_light_place(sky, x, all<T>(float(row.row) * spacing), share);
        const SunDepths<T> sum = march_to_sun(k, field, p, iota<I<W>>() + i <= row.last, counts,
                                              view.near_steps, k.light.steps);
        const T units = min_(sum.tau * kSkyLightUnit + 0.5f, all<T>(65535.0f));
        for (int l = 0; l < W; ++l) depth[i - row.first + l] = std::int32_t(lane(units, l));
    }
    std::int32_t* to = words + sky_light_row_start(view, row.level, row.height, row.row);
    for (std::int32_t i = row.first; i < row.last; ++i) {
        const std::uint32_t low = std::uint32_t(depth[i - row.first]);
        const std::uint32_t high = std::uint32_t(depth[i - row.first + 1]);
        to[i & ((1 << view.bits) - 1)] = std::int32_t(low | high << 16);
    }
}

template <int W>
PILEUS_FN void sky_light_rows(const SkyLightParams& k, const SkyLightBuffers& b,
                              std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t r = begin; r < end; ++r) {
        std::int64_t counts[kRaymarchCounts] = {};
        sky_light_row<W>(k.march, k.sky, k.view, b.rows[r], b.words, counts);
        b.read[r] = counts[kCountLightSamples];
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
