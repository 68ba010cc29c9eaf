// SPDX-License-Identifier: Apache-2.0
// Ends of flights: scattering, the ground, the sky, and the light that shadow rays bring.
// in: lanes whose flight has ended -> out: lanes due for the next flight, radiance added.
// docs/path.md: next-event estimation; sky maps by the balance heuristic (Veach 1997, 9.2).
#pragma once
#include "kernels_cpu/core/meshes.h"
#include "kernels_cpu/light/sun_heights.h"
#include "kernels_cpu/path/path_sea.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Reflections after which a path is given up, where solids reflect all light.
constexpr std::int32_t kMaxBounces = 1 << 14;

/// Real collisions in the lanes of `m`.
template <int W, int NC, int K>
PILEUS_FN void scatter_path(PathLanes<W, NC, K>& s, const PathParams& k, PathTally& tally, M<W> m) {
    using T = F<W>;
    end_paths(s, m & (s.order >= k.max_depth));
    m = m & s.alive;
    if (!any(m)) return;
    tally.scatterings += count_bits(bits_of(m));
    s.cloud = s.cloud | (m & (s.order + s.bounces == 0));
    s.order = select(m, s.order + 1, s.order);
    s.outside = s.outside & lnot(m);
    s.vertex = {select(m, s.p.x, s.vertex.x), select(m, s.p.y, s.vertex.y),
                select(m, s.p.z, s.vertex.z)};

    const Words<U<W>> w = draw(s, k, m);
    const T u = uniform_open(w.a);
    const T to_sun = one_minus_cosine(s.d, sun_of(s, k));
    const bool map = k.map.columns > 0;
    T to_map{}, to_map_density{};
    U<W> map_luck{};
    if (map) {
        map_luck = aim_at_map(s, k, m);
        to_map = one_minus_cosine(s.d, s.to_map);
    }
    Turn<T> turn{};
    for_media(s, k, m, [&](const Optics& optics, M<W> mine) {
        for (int c = 0; c < NC; ++c)
            s.beta[c] = select(mine, s.beta[c] * optics.albedo[c], s.beta[c]);
        const Turn<T> own = phase_sample(optics.phase, u);
        turn.one_minus_cos = select(mine, own.one_minus_cos, turn.one_minus_cos);
        turn.sine = select(mine, own.sine, turn.sine);
        if (k.sunlit != 0) s.shade = select(mine, phase_density(optics.phase, to_sun), s.shade);
        if (!map) return;
        to_map_density = select(mine, phase_density(optics.phase, to_map), to_map_density);
        // Straight on: no ray to the map is drawn from a peak without width.
        const T density =
            select(own.one_minus_cos > 0.0f, phase_density(optics.phase, own.one_minus_cos), T{});
        s.next_density = select(mine, density, s.next_density);
    });
    M<W> mapped = m & lnot(m), mappable = m;
    if constexpr (kGuided<K>) mappable = m & lnot(s.branch);
    if (map) mapped = map_rays(s, k, mappable, to_map_density, to_map_density, map_luck);
    const SinCos<T> phi = sincos_turns(uniform(w.b));
    const Vec<T> d = turned(s.d, 1.0f - turn.one_minus_cos, turn.sine, phi.cosine, phi.sine);
    s.next = {select(m, d.x, s.next.x), select(m, d.y, s.next.y), select(m, d.z, s.next.z)};
    if constexpr (kGuided<K>)
        seek_sun(s, k, m, [&](const Vec<T>& way, M<W> lanes) {
            const T one_minus_cos = one_minus_cosine(s.d, way);
            T density{};
            for_media(s, k, lanes, [&](const Optics& optics, M<W> mine) {
                density = select(mine, phase_density(optics.phase, one_minus_cos), density);
            });
            // No branch goes where a peak without width leads.
            return select(one_minus_cos > 0.0f, density, all<T>(1e30f));
        });
    first_flight(s, k, m, mapped, spare_bits(w));
    if constexpr (kLamps<K>)
        seek_lamps(
            s, k, m, k.lamp_near, [](const Vec<T>&) { return all<T>(1.0f); },
            [&](const Vec<T>& way, M<W> lanes) {
                const T one_minus_cos = one_minus_cosine(s.d, way);
                T density{};
                for_media(s, k, lanes, [&](const Optics& optics, M<W> mine) {
                    density = select(mine, phase_density(optics.phase, one_minus_cos), density);
                });
                return density;
            });
}

/// The lanes of `m` meet the ground at `at`, metres.
template <int W, int NC, int K>
PILEUS_FN void reflect_path(PathLanes<W, NC, K>& s, const PathParams& k, PathTally& tally, M<W> m,
                            const Vec<F<W>>& at) {
    using T = F<W>;
    constexpr float kInvPi = 4.0f * kInvFourPi;
    tally.bounces += count_bits(bits_of(m));
    s.bounces = select(m, s.bounces + 1, s.bounces);
    s.outside = s.outside | m;
    s.vertex = {select(m, at.x, s.vertex.x), select(m, at.y, s.vertex.y),
                select(m, at.z, s.vertex.z)};
    if (is_painted(k.paint)) {
        T share[3];
        ground_share(k.paint, at, I<W>{}, share);
        if (k.paint.sea != nullptr) return reflect_at_sea(s, k, m, at, share);
        for (int c = 0; c < NC; ++c) s.beta[c] = select(m, s.beta[c] * share[c], s.beta[c]);
    }
    for (int c = 0; c < NC; ++c) s.beta[c] = select(m, s.beta[c] * k.ground_albedo, s.beta[c]);
    const Words<U<W>> w = draw(s, k, m);
    const Lambert<T> up = lambert(w);
    const T height = max_(up.normal, all<T>(1e-6f));
    s.next = {select(m, up.a, s.next.x), select(m, up.b, s.next.y), select(m, height, s.next.z)};
    s.next_density = select(m, height * kInvPi, s.next_density);
    s.shade = select(m, max_(sun_of(s, k).z, T{}) * kInvPi, s.shade);
    M<W> mapped = m & lnot(m);
    if (k.map.columns > 0) {
        const U<W> luck = aim_at_map(s, k, m);
        const T facing = max_(s.to_map.z, T{}) * kInvPi;
        mapped = map_rays(s, k, m, facing, facing, luck);
    }
    if constexpr (kGuided<K>)
        seek_sun(s, k, m, [&](const Vec<T>& way, M<W>) { return max_(way.z, T{}) * kInvPi; });
    first_flight(s, k, m, mapped, spare_bits(w));
    if constexpr (kLamps<K>)
        seek_lamps(
            s, k, m, 0, [](const Vec<T>& way) { return way.z; },
            [&](const Vec<T>& way, M<W>) { return max_(way.z, T{}) * kInvPi; });
}

/// The lanes of `m` meet a solid.
template <int W, int NC, int K>
PILEUS_FN void reflect_at_solid(PathLanes<W, NC, K>& s, const PathParams& k, PathTally& tally,
                                M<W> m) {
    using T = F<W>;
    constexpr float kInvPi = 4.0f * kInvFourPi;
    const SolidPlace<T> place = place_on_solid(
        k.solids, vertex_metres(s, k), s.d, SolidHit<T>{s.wall, select(m, s.piece, s.piece | -1)});
    const Vec<T>& n = place.normal;
    tally.bounces += count_bits(bits_of(m));
    s.bounces = select(m, s.bounces + 1, s.bounces);
    s.outside = s.outside | m;
    s.vertex = {select(m, place.at.x, s.vertex.x), select(m, place.at.y, s.vertex.y),
                select(m, place.at.z, s.vertex.z)};
    for (int c = 0; c < NC; ++c) s.beta[c] = select(m, s.beta[c] * place.albedo[c], s.beta[c]);
    const Words<U<W>> w = draw(s, k, m);
    const Lambert<T> up = lambert(w);
    const T height = max_(up.normal, all<T>(1e-6f));
    const Vec<T> d = turned(n, height, all<T>(1.0f), up.a, up.b);
    s.next = {select(m, d.x, s.next.x), select(m, d.y, s.next.y), select(m, d.z, s.next.z)};
    s.next_density = select(m, height * kInvPi, s.next_density);
    s.shade = select(m, max_(dot(n, sun_of(s, k)), T{}) * kInvPi, s.shade);
    M<W> mapped = m & lnot(m);
    if (k.map.columns > 0) {
        const U<W> luck = aim_at_map(s, k, m);
        const T facing = max_(dot(s.to_map, n), T{}) * kInvPi;
        mapped = map_rays(s, k, m, facing, facing, luck);
    }
    if constexpr (kGuided<K>)
        seek_sun(s, k, m, [&](const Vec<T>& way, M<W>) { return max_(dot(way, n), T{}) * kInvPi; });
    first_flight(s, k, m, mapped, spare_bits(w));
    if constexpr (kLamps<K>)
        seek_lamps(
            s, k, m, 0, [&](const Vec<T>& way) { return dot(way, n); },
            [&](const Vec<T>& way, M<W>) { return max_(dot(way, n), T{}) * kInvPi; });
    // Black surfaces end paths; between white ones a path would go on for ever.
    const M<W> endless = m & (s.bounces >= kMaxBounces);
    tally.terminated += count_bits(bits_of(endless));
    end_paths(s, endless | (m & lnot(heaviest(s) > 0.0f)));
}

/// The sky's light along `d`.
template <int W>
PILEUS_FN Vec<F<W>> sky_light(const PathParams& k, const Vec<F<W>>& d) {
    if (k.map.columns > 0) return map_radiance(k.map, d);
    return {all<F<W>>(k.sky[0]), all<F<W>>(k.sky[1]), all<F<W>>(k.sky[2])};
}

/// Paths of the lanes of `m` see the sky along their direction, and end.
template <int W, int NC, int K>
PILEUS_FN void reach_sky(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m) {
    using T = F<W>;
    T share = all<T>(1.0f);
    if (k.map.columns > 0) {
        // The camera's own rays see the map alone; so does a turn by exactly nothing.
        const T own = s.next_density, other = sky_density(k.map, k.sampler, s.d);
        const M<W> both = (s.order + s.bounces > 0) & (own > 0.0f);
        share = select(both, balanced(own, other), share);
    }
    add_light(s, k, m, share, sky_light<W>(k, s.d), s.alive & lnot(s.alive));
    end_paths(s, m);
}

/// Paths of the lanes of `m` have left the box: the ground reflects them or the sky ends them.
/// Returns the lanes that go on.
template <int W, int NC, int K>
PILEUS_FN M<W> leave_media(PathLanes<W, NC, K>& s, const PathParams& k, PathTally& tally, M<W> m) {
    using T = F<W>;
    s.out = s.out & lnot(m);
    if constexpr (kGuided<K>) m = leave_branches(s, m);
    M<W> ground = m & lnot(m), solid = ground;
    if constexpr (kSolid<K>) {
        solid = m & (s.piece >= 0);
        end_paths(s, m & (s.piece == kImageWall));
        m = m & (s.piece == kNoWall);
        if (has_meshes(k.solids) && any(solid)) reflect_at_solid(s, k, tally, solid);
    }
    if (k.ground != 0) {
        const auto metres = [&](T v, int a) { return select(s.outside, v, v * k.grid.cell[a]); };
        const Vec<T> o{metres(s.vertex.x, 0), metres(s.vertex.y, 1), metres(s.vertex.z, 2)};
        const T height = o.z - k.ground_z;
        ground = m & (s.d.z < 0.0f) & (height >= 0.0f);
        if (k.ground_albedo > 0.0f && any(ground)) {
            const T t = height / max_(T{} - s.d.z, all<T>(1e-18f));
            reflect_path(s, k, tally, ground,
                         Vec<T>{o.x + s.d.x * t, o.y + s.d.y * t, all<T>(k.ground_z)});
        } else {
            end_paths(s, ground);
        }
    }
    const M<W> sky = m & lnot(ground);
    if (any(sky)) reach_sky(s, k, sky);
    return (ground | solid) & s.alive;
}

/// Shadow rays of the lanes of `m` have ended: add what they bring, choose the next flight.
template <int W, int NC, int K>
PILEUS_FN void gather_light(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m) {
    using T = F<W>;
    s.lit = s.lit & lnot(m);
    const M<W> sun = m & (s.flight == kFlightSun), map = m & lnot(sun);
    Vec<T> light{all<T>(k.sun[0]), all<T>(k.sun[1]), all<T>(k.sun[2])};
    if (k.sun_heights.rows != 0 && any(sun)) {
        const T z = vertex_metres(s, k).z;
        light = {sun_at(k.sun_heights, z, 0), sun_at(k.sun_heights, z, 1),
                 sun_at(k.sun_heights, z, 2)};
    }
    if (any(map)) {
        const Vec<T> sky = map_radiance(k.map, s.d);
        light = {select(map, sky.x, light.x), select(map, sky.y, light.y),
                 select(map, sky.z, light.z)};
    }
    add_light(s, k, m, (s.seen + s.carry) * s.shade, light, sun);
    s.flight = select(m, all<I<W>>(kFlightPath), s.flight);
    s.flight = select(sun & s.mapped, all<I<W>>(kFlightMap), s.flight);
    s.shade = select(sun, s.map_shade, s.shade);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
