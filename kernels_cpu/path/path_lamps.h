// SPDX-License-Identifier: Apache-2.0
// Paths lit by point, spot and parallel lights: rays towards them from vertices and from between.
// in: a vertex, or the flight that ended there -> out: a ray due, with the light that it would
// bring. docs/lights.md, "By path": near a light the part of a flight that was flown free is
// sampled by angle (Kulla and Fajardo 2012); beyond, light comes to the vertices.
#pragma once
#include "kernels_cpu/light/lamp_sphere.h"
#include "kernels_cpu/path/path_lanes.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Add what ended rays to lamps in the lanes of `m` bring, and let those go on that stand between
/// two vertices. Returns the lanes whose next flight is due.
template <int W, int NC, int K>
PILEUS_FN M<W> gather_lamps(PathLanes<W, NC, K>& s, const PathParams& k) {
    using T = F<W>;
    const M<W> m = s.lit & (s.flight >= kFlightNear);
    if (!any(m)) return m;
    s.lit = s.lit & lnot(m);
    const M<W> near = m & (s.flight == kFlightNear), far = m & lnot(near);
    const T seen = select(m, s.seen + s.carry, T{});
    for (int c = 0; c < 3; ++c) {
        const T value = select(m, seen * s.lamp_light[c], T{});
        s.sum[c] = s.sum[c] + value;
        if (k.parts_wanted == 0) continue;
        const auto add = [&](PathPart part, M<W> in) {
            s.sum[3 * part + c] = s.sum[3 * part + c] + select(in, value, T{});
        };
        add(kPathSingle, s.lamp_single);
        add(kPathCloud, s.lamp_cloud);
    }
    s.p = {select(near, s.kept_p.x, s.p.x), select(near, s.kept_p.y, s.p.y),
           select(near, s.kept_p.z, s.p.z)};
    s.d = {select(near, s.kept_d.x, s.d.x), select(near, s.kept_d.y, s.d.y),
           select(near, s.kept_d.z, s.d.z)};
    s.met = s.met | (near & s.kept_met);
    s.out = s.out | (near & lnot(s.kept_met));
    s.flight = select(near, all<I<W>>(kFlightPath), select(far, s.after, s.flight));
    return far;
}

/// Of all lamps choose one in every lane, as likely as its `weight(lamp)` is large; `take(lamp,
/// lanes, chance)` is called for each that is chosen. `luck` in [0, 1).
template <int W, class Weight, class Take>
PILEUS_FN void choose_lamp(const PathParams& k, M<W> m, F<W> luck, Weight weight, Take take) {
    using T = F<W>;
    T total{};
    for (int i = 0; i < k.lamp_count; ++i) total = total + select(m, weight(k.lamps[i]), T{});
    M<W> open = m & (total > 0.0f);
    const T mark = luck * total, inverse = 1.0f / max_(total, all<T>(1e-37f));
    T sum{};
    for (int i = 0; i < k.lamp_count && any(open); ++i) {
        const T own = select(m, weight(k.lamps[i]), T{});
        sum = sum + own;
        const M<W> here = open & (mark < sum) & (own > 0.0f);
        if (!any(here)) continue;
        open = open & lnot(here);
        take(k.lamps[i], here, own * inverse);
    }
}

/// Two more random numbers, for places on spheres; drawn where there are spheres alone.
template <int W, int NC, int K>
PILEUS_FN Words<U<W>> draw_place(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m) {
    return k.lamp_spheres != 0 ? draw(s, k, m) : Words<U<W>>{};
}

/// The lamp, or a place on it, as it is seen from a point.
template <class T, class UU>
PILEUS_FN LampSight<T> see_drawn(const LampParams& lamp, const Vec<T>& from, const Words<UU>& w) {
    if (lamp.radius > 0.0f)
        return lamp_place(lamp, lamp_cone(lamp, from), uniform(w.a), uniform(w.b));
    return see_lamp(lamp, from);
}

/// Flights of paths that have just ended: the lanes that got a ray from a point between their ends
/// to a lamp wait for it with their end kept; these are returned.
template <int W, int NC, int K>
PILEUS_FN M<W> begin_near(PathLanes<W, NC, K>& s, const PathParams& k) {
    using T = F<W>;
    const M<W> ended = (s.met | s.out) & lnot(s.near_done) & (s.flight == kFlightPath);
    s.near_done = s.near_done | ended;
    M<W> m = ended & (s.order < k.max_depth);
    if constexpr (kGuided<K>) m = m & lnot(s.branch);
    if (!any(m)) return m;
    const auto metres = [&](T v, int a) { return v * k.grid.cell[a]; };
    const Vec<T> o{metres(s.from.x, 0), metres(s.from.y, 1), metres(s.from.z, 2)};
    const auto chord = [&](const LampParams& lamp) {
        return lamp_chord(lamp, o, s.d, s.t, k.lamp_near);
    };
    // Most flights are not near any lamp: they draw nothing.
    T reach{};
    const auto weight = [&](const LampParams& lamp) {
        if (lamp.parallel != 0) return T{};
        const LampChord<T> c = chord(lamp);
        return lamp.strength * c.angle / c.height;
    };
    for (int i = 0; i < k.lamp_count; ++i) reach = reach + weight(k.lamps[i]);
    m = m & (reach > 0.0f);
    if (!any(m)) return m;
    const Words<U<W>> w = draw(s, k, m), more = draw(s, k, m);
    const Words<U<W>> where = draw_place(s, k, m);
    M<W> rays = m & lnot(m);
    choose_lamp<W>(k, m, uniform(w.a), weight, [&](const LampParams& lamp, M<W> mine, T chance) {
        T length;
        const T t = point_of_chord(chord(lamp), uniform(w.b), length);
        const Vec<T> x{o.x + s.d.x * t, o.y + s.d.y * t, o.z + s.d.z * t};
        const auto voxels = [&](T v, int a) {
            const T at =
                min_(max_(v * (1.0f / k.grid.cell[a]), T{}), all<T>(float(k.grid.size[a])));
            return select(mine, at, T{});
        };
        const Vec<T> p{voxels(x.x, 0), voxels(x.y, 1), voxels(x.z, 2)};
        const I<W> corner = corner_voxel(p, more.a, k.grid);
        const T density = gather(k.grid.density, corner);
        const LampSight<T> sight = see_drawn(lamp, x, where);
        const T worth =
            density * k.grid.sigma * length * sight.share / max_(chance, all<T>(1e-30f));
        mine = mine & (worth > 0.0f);
        if (!any(mine)) return;
        // The medium there, not that of the flight's end.
        const I<W> kept = s.medium;
        if (k.media > 1) {
            const std::int64_t all_voxels =
                std::int64_t(k.grid.size[0]) * k.grid.size[1] * k.grid.size[2];
            s.medium =
                medium_under(k.parts, all_voxels, k.media, corner, uniform(more.b) * density);
        }
        const T turn = one_minus_cosine(s.d, sight.way);
        for_media(s, k, mine, [&](const Optics& optics, M<W> of) {
            const T value = worth * phase_density(optics.phase, turn);
            for (int c = 0; c < 3; ++c) {
                const int channel = NC == 1 ? 0 : c;
                s.lamp_light[c] =
                    select(of, s.beta[channel] * optics.albedo[channel] * value * lamp.light[c],
                           s.lamp_light[c]);
            }
        });
        s.medium = kept;
        s.near = {select(mine, p.x, s.near.x), select(mine, p.y, s.near.y),
                  select(mine, p.z, s.near.z)};
        aim_at_lamp(s, mine, sight);
        rays = rays | mine;
    });
    s.kept_p = {select(rays, s.p.x, s.kept_p.x), select(rays, s.p.y, s.kept_p.y),
                select(rays, s.p.z, s.kept_p.z)};
    s.kept_d = {select(rays, s.d.x, s.kept_d.x), select(rays, s.d.y, s.kept_d.y),
                select(rays, s.d.z, s.kept_d.z)};
    s.kept_met = (s.kept_met & lnot(rays)) | (s.met & rays);
    s.met = s.met & lnot(rays);
    s.out = s.out & lnot(rays);
    s.flight = select(rays, all<I<W>>(kFlightNear), s.flight);
    const M<W> first = s.order + s.bounces == 0;
    s.lamp_single = (s.lamp_single & lnot(rays)) | (rays & first);
    s.lamp_cloud = (s.lamp_cloud & lnot(rays)) | (rays & (first | s.cloud));
    return rays;
}

/// New vertices in the lanes of `m`, whose next flight is chosen: where a lamp brings light, a ray
/// to it flies first. `facing(way)`: cosine with a surface's normal, 1 in media; `value(way,
/// lanes)`: light that goes on per irradiance, 1/sr. `sphere`: lamps nearer than this are left to
/// begin_near.
template <int W, int NC, int K, class Facing, class Value>
PILEUS_FN void seek_lamps(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m, float sphere,
                          Facing facing, Value value) {
    using T = F<W>;
    if (!minds_lamps<K>(k)) return;
    if constexpr (kGuided<K>) m = m & lnot(s.branch);
    m = m & s.alive;
    if (!any(m)) return;
    const Vec<T> o = vertex_metres(s, k);
    const Words<U<W>> w = draw(s, k, m), where = draw_place(s, k, m);
    M<W> rays = m & lnot(m);
    const auto weight = [&](const LampParams& lamp) {
        if (lamp.radius > 0.0f) {
            // A bound: of a sphere whose middle is not seen a part may be.
            const LampCone<T> cone = lamp_cone(lamp, o);
            const T facet = max_(most_cosine(cone, facing(cone.way)), T{});
            return select(cone.distance >= sphere, lamp.strength * most_share(lamp, cone) * facet,
                          T{});
        }
        const LampSight<T> sight = see_lamp(lamp, o);
        const T light = lamp.strength * sight.share * max_(facing(sight.way), T{});
        return select(sight.distance >= sphere, light, T{});
    };
    choose_lamp<W>(k, m, uniform(w.a), weight, [&](const LampParams& lamp, M<W> mine, T chance) {
        const LampSight<T> sight = see_drawn(lamp, o, where);
        const T worth = value(sight.way, mine) * sight.share / max_(chance, all<T>(1e-30f));
        mine = mine & (worth > 0.0f);
        for (int c = 0; c < 3; ++c)
            s.lamp_light[c] =
                select(mine, s.beta[NC == 1 ? 0 : c] * worth * lamp.light[c], s.lamp_light[c]);
        aim_at_lamp(s, mine, sight);
        rays = rays | mine;
    });
    s.after = select(rays, s.flight, s.after);
    s.flight = select(rays, all<I<W>>(kFlightLamp), s.flight);
    s.lamp_single = (s.lamp_single & lnot(rays)) | (rays & s.cloud & (s.order + s.bounces == 1));
    s.lamp_cloud = (s.lamp_cloud & lnot(rays)) | (rays & s.cloud);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
