// SPDX-License-Identifier: Apache-2.0
// Light that a painted ground sends to the eye: the map's albedo, or a sea.
// in: what falls on the ground, grey -> out: radiance by channel. docs/ground.md
#pragma once
#include "kernels_cpu/light/painted.h"
#include "kernels_cpu/light/sea.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// The level of a map whose texels are as large as a pixel.
template <class T>
PILEUS_FN I_of<T> map_level(const GroundPaint& p, T metres) {
    T texels = metres / (p.map.levels > 0 ? p.map.texel_m : 1.0f);
    I_of<T> level{};
    for (int i = 1; i < p.map.levels; ++i) {
        texels = texels * 0.5f;
        level = select(texels >= 1.0f, all<I_of<T>>(i), level);
    }
    return level;
}

/// A number moved by whole periods into [0, period].
template <class T>
PILEUS_FN T within_period(T v, float period) {
    const T turns = v * (1.0f / period);
    return min_(max_((turns - to_float(floor_int(turns))) * period, T{}), all<T>(period));
}

/// Texels below and above a place in texels' middles, and the share of the latter.
template <class T>
struct MapCorners {
    I_of<T> low, high;
    T share;
};
template <class T>
PILEUS_FN MapCorners<T> map_corners(T p, I_of<T> count, std::int32_t repeats) {
    using II = I_of<T>;
    const II last = count - 1;
    if (repeats == 0) {
        const T q = min_(max_(p, T{}), to_float(last));
        const II low = to_int(q);
        return {low, min_(low + 1, last), q - to_float(low)};
    }
    const II whole = floor_int(p), low = select(whole < 0, last, min_(whole, last));
    return {low, select(low == last, II{}, low + 1), p - to_float(whole)};
}

/// Albedo at a place over the one that the ground's radiances are made with, by channel. `level`:
/// of the map.
template <class T>
PILEUS_FN void ground_share(const GroundPaint& p, const Vec<T>& at, I_of<T> level, T (&out)[3]) {
    using II = I_of<T>;
    for (int c = 0; c < 3; ++c) out[c] = all<T>(p.share[c]);
    const GroundMapView& m = p.map;
    if (m.columns == 0) return;
    T x = at.x * m.to_column[0] + at.y * m.to_column[1] + m.to_column[2];
    T y = at.x * m.to_row[0] + at.y * m.to_row[1] + m.to_row[2];
    if (m.repeats != 0) {
        x = within_period(x, float(m.columns));
        y = within_period(y, float(m.rows));
    }
    const auto within = (x >= 0.0f) & (x <= float(m.columns)) & (y >= 0.0f) & (y <= float(m.rows));
    II first{}, columns = all<II>(m.columns), rows = all<II>(m.rows);
    T half = all<T>(1.0f);
    for (int i = 1; i < m.levels; ++i) {
        const auto coarser = level >= i;
        first = select(coarser, all<II>(m.first[i]), first);
        columns = select(coarser, (columns + 1) >> 1, columns);
        rows = select(coarser, (rows + 1) >> 1, rows);
        half = select(coarser, half * 0.5f, half);
    }
    const MapCorners<T> u = map_corners(select(within, x, T{}) * half - 0.5f, columns, m.repeats);
    const MapCorners<T> v = map_corners(select(within, y, T{}) * half - 0.5f, rows, m.repeats);
    const II x0 = u.low, x1 = u.high, y0 = v.low, y1 = v.high;
    const T fx = u.share, fy = v.share;
    T grey{};
    for (int c = 0; c < 3; ++c) {
        if (c < m.planes) {
            const float* plane = m.albedo + std::int64_t(c) * m.texels;
            const T a = gather(plane, first + y0 * columns + x0);
            const T b = gather(plane, first + y0 * columns + x1);
            const T d = gather(plane, first + y1 * columns + x0);
            const T e = gather(plane, first + y1 * columns + x1);
            const T low = a + (b - a) * fx, high = d + (e - d) * fx;
            grey = (low + (high - low) * fy) * p.per_albedo;
        }
        out[c] = select(within, grey, out[c]);
    }
}

/// Edge of a pixel on the ground, metres: the geometric mean.
template <class T>
PILEUS_FN T pixel_on_ground(const GroundPaint& p, T distance, T rise) {
    return distance * p.texel_turn / sqrt_(max_(rise, all<T>(1e-4f)));
}

/// The direction in which the map holds what a ray from `at` along `way` meets.
template <class T>
PILEUS_FN Vec<T> seen_in_mirror(const GroundPaint& p, const Vec<T>& at, const Vec<T>& way) {
    if (!(p.mirror_m > 0.0f)) return way;
    const T far = p.mirror_m / max_(way.z, all<T>(1e-3f));
    return normalized(Vec<T>{at.x - p.mirror_from[0] + way.x * far,
                             at.y - p.mirror_from[1] + way.y * far,
                             at.z - p.mirror_from[2] + way.z * far});
}

/// What a sea reflects of what is around along `from`, but for the sun. `reflects`: of even light.
template <class T>
PILEUS_FN void sea_mirrors(const GroundPaint& p, const Vec<T>& at, const SeaPlace<T>& place,
                           const SeaSight<T>& sight, const Vec<T>& from, T (&out)[3], T& reflects) {
    const SeaView& sea = *p.sea;
    T sum[3] = {}, whole{}, all_of{};
    for (int i = 0; i < kSeaAlong; ++i) {
        const T shown = max_(sight.even + sight.leans * sea.along[i], T{}) * sea.along_weight[i];
        if (!any(shown > 0.0f)) continue;
        for (int j = 0; j < kSeaAcross; ++j) {
            T cosine;
            const Vec<T> way = sea_mirror(place, from, place.slope * sea.along[i],
                                          place.slope * sea.across[j], cosine);
            const T facets = shown * sea.across_weight[j];
            const T weight = facets * water_reflects(max_(cosine, T{}));
            all_of = all_of + facets;
            whole = whole + weight;
            if (p.sky.columns == 0) continue;
            const Vec<T> light = map_radiance(p.sky, seen_in_mirror(p, at, way));
            sum[0] = sum[0] + weight * light.x;
            sum[1] = sum[1] + weight * light.y;
            sum[2] = sum[2] + weight * light.z;
        }
    }
    const T unit = 1.0f / max_(all_of, all<T>(1e-30f));
    reflects = whole * unit;
    for (int c = 0; c < 3; ++c) out[c] = p.sky.columns == 0 ? reflects * p.even[c] : sum[c] * unit;
}

/// Radiance of a painted ground. `diffuse`: what it sends as a grey one but for the sun's light,
/// which is `by_sun`, of which the share `sunlight` arrives; `along`: the way of the ray down.
template <class T>
PILEUS_FN void painted_ground(const GroundPaint& p, const Vec<T>& at, const Vec<T>& along,
                              T distance, const T (&diffuse)[3], const float (&by_sun)[3],
                              const T (&sunlight)[3], const float (&to_sun)[3], T (&out)[3]) {
    const T rise = max_(T{} - along.z, T{}), metres = pixel_on_ground(p, distance, rise);
    T share[3];
    ground_share(p, at, map_level(p, metres), share);
    for (int c = 0; c < 3; ++c)
        out[c] = share[c] * (diffuse[c] + sunlight[c] * (by_sun[c] * p.share_sun));
    if (p.sea == nullptr) return;
    const SeaView& sea = *p.sea;
    const Vec<T> from{T{} - along.x, T{} - along.y, rise};
    const SeaPlace<T> place = sea_place(sea, p.waves, at, metres, rise);
    const SeaSight<T> sight = sea_sight(sea, place, from);
    T mirrored[3], density, reflects;
    sea_mirrors(p, at, place, sight, from, mirrored, reflects);
    const Vec<T> sun{all<T>(to_sun[0]), all<T>(to_sun[1]), all<T>(to_sun[2])};
    const T glint = sea_glint(place, sight.seen, from, sun, density);
    for (int c = 0; c < 3; ++c)
        out[c] = (1.0f - reflects) * out[c] + mirrored[c] + glint * sunlight[c] * p.sun[c];
}

}  // namespace PILEUS_ISA
}  // namespace pileus
