// SPDX-License-Identifier: Apache-2.0
// Rays towards lights from a new vertex: which fly, and which first.
// in: a vertex, the light that goes on from it -> out: the flight that is due.
// docs/path.md: next-event estimation; sky maps by the balance heuristic (Veach 1997, 9.2).
#pragma once
#include "kernels_cpu/path/path_guide.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Of the shadow rays that leave the lanes of `m`, leave out by luck those that would bring little:
/// `value`, per steradian, for each unit of irradiance that the light could give. The others bring
/// theirs, `shade` is raised. Rays of the first vertex, which carry the picture's detail, are all
/// kept. `spare` are 16 random bits. Returns the lanes that fly.
template <int W, int NC, int K>
PILEUS_FN M<W> thin_out_rays(const PathLanes<W, NC, K>& s, const PathParams& k, M<W> m, F<W> value,
                             U<W> spare, F<W>& shade) {
    using T = F<W>;
    constexpr float kSteps = 0x1p16f;
    const M<W> low = m & (heaviest(s) * value < k.light_roulette) & (s.order + s.bounces > 1);
    if (!any(low)) return m;
    const T least = select(low, heaviest(s) * value, T{}) * (1.0f / k.light_roulette);
    const T chance = whole_chance(least, kSteps);
    const M<W> lost = low & lnot(to_float(reinterpret<I<W>>(spare)) < chance * kSteps);
    shade = select(low, shade / chance, shade);
    return m & lnot(lost);
}

/// Choose the first flight from a new vertex: the sun's, the map's or the path's own. The lanes of
/// `mapped` have a ray to the map.
template <int W, int NC, int K>
PILEUS_FN void first_flight(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m, M<W> mapped,
                            U<W> spare) {
    M<W> sun = m & (s.shade > 0.0f);
    if (k.sunlit != 0) sun = thin_out_rays(s, k, sun, s.shade, spare, s.shade);
    s.flight = select(m, all<I<W>>(kFlightPath), s.flight);
    s.flight = select(mapped, all<I<W>>(kFlightMap), s.flight);
    s.mapped = (s.mapped & lnot(m)) | mapped;
    if (k.sunlit != 0) s.flight = select(sun, all<I<W>>(kFlightSun), s.flight);
    mapped = m & (s.flight == kFlightMap);
    s.shade = select(mapped, s.map_shade, s.shade);
}

/// Draw a direction towards the map for the lanes of `m`; returns 16 random bits that are left.
template <int W, int NC, int K>
PILEUS_FN U<W> aim_at_map(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m) {
    const Words<U<W>> texel = draw(s, k, m), place = draw(s, k, m);
    const Vec<F<W>> d = draw_sky<F<W>>(k.map, k.sampler, texel, place);
    s.to_map.x = select(m, d.x, s.to_map.x);
    s.to_map.y = select(m, d.y, s.to_map.y);
    s.to_map.z = select(m, d.z, s.to_map.z);
    return spare_bits(place);
}

/// Value over the sum of both densities: what the balance heuristic makes of a light's share, as
/// the path draws its own directions with a density equal to that value.
template <class T>
PILEUS_FN T balanced(T own, T other) {
    return own / max_(own + other, all<T>(1e-30f));
}

/// Weigh the ray to the map, drawn where a path's own turn has the density `own`, and choose the
/// lanes of `m` in which it flies. `value`: light that goes on per irradiance, 1/sr, for each unit
/// of the path's weight.
template <int W, int NC, int K>
PILEUS_FN M<W> map_rays(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m, F<W> own, F<W> value,
                        U<W> spare) {
    const F<W> other = sky_density(k.map, k.sampler, s.to_map);
    F<W> shade = value / max_(own + other, all<F<W>>(1e-30f));
    // The map's light, all of it, times the density of this direction is its radiance.
    const M<W> mapped = thin_out_rays(s, k, m & (shade > 0.0f), shade * other, spare, shade);
    s.map_shade = select(m, shade, s.map_shade);
    return mapped;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
