// SPDX-License-Identifier: Apache-2.0
// Where a photon begins: on the box's silhouette (beam, sky map), its faces (diffuse light), at a
// lamp, or within a medium that shines.
// in: photon numbers -> out: position (voxels) and direction of travel.
// docs/methods.md 3 "Shoot"; points from the R2 sequence (Roberts 2018), shifted at random.
#pragma once
#include "kernels_cpu/light/lambert.h"
#include "kernels_cpu/media/walk.h"
#include "kernels_cpu/photons/trace_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// The solid thing ahead of a photon; nothing where the scene has none.
template <int W, bool S>
struct Ahead {};
template <int W>
struct Ahead<W, true> {
    F<W> wall;     // metres to it along the flight; below 0: to be found anew
    I<W> piece;    // triangle; -1: none
    M<W> stopped;  // stands at it
};

/// Everything a lane knows of its photon, `S`: among solids.
template <int W, int NC, bool S>
struct Photon : Walker<W>, Ahead<W, S> {
    F<W> weight[NC], path;  // share left per channel; metres
    U<W> index, event;
    F<W> room, bound;          // metres to the end of the block; its majorant
    I<W> exit, reach;          // axis across which it ends; empty blocks around it
    I<W> enters;               // -1: the three above are to be found anew
    I<W> order;                // scatterings so far, bounces included
    I<W> strayed;              // 1: by a bounce, or by a turn that its beam does not keep
    I<W> texel;                // of the sky map that it comes from, or its lamp
    M<W> alive, shadow, owes;  // owes: the ground below misses this photon's light
    F<W> owed_x, owed_y;       // where on the ground, metres
    F<W> ground_x, ground_y;   // where on the ground the next bounce starts, metres
};

/// Position (voxels) and direction of travel of photons that begin.
template <class T>
struct Start {
    Vec<T> p, d;
};

/// A place on the box's faces, and whose.
template <int W>
struct FacePlace {
    Vec<F<W>> p;
    M<W> on_x, on_y, high;
};
/// `cdf`: the faces' shares of the flux, as in TraceParams; u and v in [0, 1).
template <int W>
PILEUS_FN FacePlace<W> place_on_faces(const TrackGrid& grid, const float (&cdf)[6], F<W> u,
                                      F<W> v) {
    using T = F<W>;
    // Choose a face by its share of the flux and stretch the rest of u over it.
    I<W> face{};
    T below{}, above = all<T>(cdf[0]);
    for (int f = 0; f < 5; ++f) {
        const auto past = u >= cdf[f];
        face = select(past, all<I<W>>(f + 1), face);
        below = select(past, all<T>(cdf[f]), below);
        above = select(past, all<T>(cdf[f + 1]), above);
    }
    u = min_((u - below) / max_(above - below, all<T>(1e-12f)), all<T>(1.0f));

    const I<W> axis = face >> 1;
    const auto on_x = axis == 0, on_y = axis == 1, high = (face & 1) != 0;
    const T nx = all<T>(float(grid.size[0])), ny = all<T>(float(grid.size[1])),
            nz = all<T>(float(grid.size[2]));
    const T zero{};
    return {{select(on_x, select(high, nx, zero), u * nx),
             select(on_y, select(high, ny, zero), select(on_x, u * ny, v * ny)),
             select(on_x, v * nz, select(on_y, v * nz, select(high, nz, zero)))},
            on_x,
            on_y,
            high};
}

/// Beam and diffuse light: a place on the box's faces, then a direction.
template <int W>
PILEUS_FN Start<F<W>> start_on_faces(const TraceParams& k, U<W> index) {
    using T = F<W>;
    const U<W> number = index + k.first_photon;
    const FacePlace<W> place =
        place_on_faces<W>(k.grid, k.face_cdf, uniform(index * kR2[0] + k.shift[0]),
                          uniform(index * kR2[1] + k.shift[1]));
    const M<W> on_x = place.on_x, on_y = place.on_y, high = place.high;

    Vec<T> d{all<T>(k.direction[0]), all<T>(k.direction[1]), all<T>(k.direction[2])};
    if (k.light == kLightDiffuse) {
        const Lambert<T> l = lambert(threefry(k.key.k0, k.key.k1, number, U<W>{}));
        const T n = select(high, T{} - l.normal, l.normal);
        d = {select(on_x, n, l.a), select(on_y, n, select(on_x, l.a, l.b)),
             select(on_x, l.b, select(on_y, l.b, n))};
        // A side face sees half of a hemisphere of sky: mirror the other half into it.
        if (k.hemisphere != 0) d.z = copysign_(d.z, all<T>(float(k.hemisphere)));
    }
    return {place.p, d};
}

/// Sky map: a direction, then a place on the silhouette that the box shows to it. The R2 sequence
/// spreads the directions over the map.
template <int W>
PILEUS_FN Start<F<W>> start_from_map(const TraceParams& k, U<W> index, I<W>& texel, M<W> m) {
    using T = F<W>;
    const U<W> number = index + k.first_photon;
    const float edge[3] = {float(k.grid.size[0]) * k.grid.cell[0],
                           float(k.grid.size[1]) * k.grid.cell[1],
                           float(k.grid.size[2]) * k.grid.cell[2]};
    const float sides = k.grid.periodic != 0 ? 0.0f : edge[2];
    const float face[3] = {edge[1] * sides, sides * edge[0], edge[0] * edge[1]};
    const MapDraw<T> draw = draw_from_map<T>(
        k.map, face, k.key, number, index * kR2[0] + k.shift[0], index * kR2[1] + k.shift[1], m);
    texel = select(m, draw.texel, texel);
    const Vec<T> d{T{} - draw.to_sky.x, T{} - draw.to_sky.y, T{} - draw.to_sky.z};

    // Choose one of the three lit faces by its share of the silhouette.
    const Words<U<W>> w = threefry(k.key.k0, k.key.k1, number, U<W>{});
    const T ax = abs_(d.x) * face[0], ay = abs_(d.y) * face[1], az = abs_(d.z) * face[2];
    const T at = uniform(w.a) * (ax + ay + az);
    const M<W> on_x = at < ax;
    const M<W> on_y = lnot(on_x) & (at < ax + ay);
    const T below = select(on_x, T{}, select(on_y, ax, ax + ay));
    const T area = select(on_x, ax, select(on_y, ay, az));
    const T u = min_((at - below) / max_(area, all<T>(1e-30f)), all<T>(1.0f));
    const T v = uniform(w.b);
    const auto entry = [](T along, std::int32_t n) {
        return select(along < 0.0f, all<T>(float(n)), T{});
    };
    const T nx = all<T>(float(k.grid.size[0])), ny = all<T>(float(k.grid.size[1])),
            nz = all<T>(float(k.grid.size[2]));
    return {{select(on_x, entry(d.x, k.grid.size[0]), u * nx),
             select(on_y, entry(d.y, k.grid.size[1]), select(on_x, u * ny, v * ny)),
             select(on_x | on_y, v * nz, entry(d.z, k.grid.size[2]))},
            d};
}

/// 1 - cosine of a direction from a spot, spread as it shines, for u in [0, 1).
template <class T>
PILEUS_FN T turn_of_spot(const LampParams& lamp, T u) {
    // Full light within the inner cone; over the penumbra the integral of its falloff is half of
    // its width, and up to the share x of it x^3 - x^4 / 2.
    const float width = 1.0f / lamp.slope, full = 1.0f - (lamp.edge + width);
    const float inner = full > 0.0f ? full : 0.0f, whole = inner + 0.5f * width;
    const float share = inner / whole;
    const float rest = 1.0f - share > 1e-12f ? 1.0f - share : 1e-12f;
    const T half = 0.5f * (1.0f - min_(max_((u - share) / rest, T{}), all<T>(1.0f)));
    // Newton's steps from above never pass the root; where that is small a step takes a third.
    T x = all<T>(1.0f);
    for (int i = 0; i < 20; ++i) {
        const T square = x * x;
        x = x - (square * x * (1.0f - 0.5f * x) - half) /
                    max_(square * (3.0f - 2.0f * x), all<T>(1e-20f));
    }
    const T outside = inner + width * (1.0f - max_(min_(x, all<T>(1.0f)), T{}));
    return select(u < share, u * whole, outside);
}

/// Counter of the numbers that choose a photon's place on a lamp: events never come so far.
constexpr std::uint32_t kPlaceOnLamp = 0xffffffffu;

/// Lamps: one by its share of their power, then a direction. `missed`: lanes whose ray misses the
/// box, and where it meets the ground.
template <int W, int NC, bool S>
PILEUS_FN Start<F<W>> start_from_lamps(Photon<W, NC, S>& s, const TraceParams& k, M<W> m,
                                       M<W>& missed) {
    using T = F<W>;
    const U<W> number = s.index + k.first_photon;
    const T u = uniform(s.index * kR2[0] + k.shift[0]), v = uniform(s.index * kR2[1] + k.shift[1]);
    const T choice = uniform(threefry(k.key.k0, k.key.k1, number, U<W>{}).a);
    I<W> which{};
    for (std::int32_t l = 1; l < k.lamp_count; ++l)
        which = select(choice >= k.lamps[l].below, all<I<W>>(l), which);
    s.texel = select(m, which, s.texel);
    const SinCos<T> phi = sincos_turns(v);
    Start<T> start{};
    for (std::int32_t l = 0; l < k.lamp_count; ++l) {
        const LampEmission& e = k.lamps[l];
        const M<W> mine = m & (which == l);
        if (!any(mine)) continue;
        const auto take = [&](const Vec<T>& p, const Vec<T>& d) {
            start.p = {select(mine, p.x, start.p.x), select(mine, p.y, start.p.y),
                       select(mine, p.z, start.p.z)};
            start.d = {select(mine, d.x, start.d.x), select(mine, d.y, start.d.y),
                       select(mine, d.z, start.d.z)};
        };
        if (e.lamp.parallel != 0) {
            const float* at = e.lamp.at;
            take(place_on_faces<W>(k.grid, e.face_cdf, u, v).p,
                 {all<T>(-at[0]), all<T>(-at[1]), all<T>(-at[2])});
            continue;
        }
        const T turn = e.span > 0.0f ? u * e.span : turn_of_spot(e.lamp, u);
        const Vec<T> axis{all<T>(e.axis[0]), all<T>(e.axis[1]), all<T>(e.axis[2])};
        const Vec<T> d =
            turned(axis, 1.0f - turn, sqrt_(max_(turn * (2.0f - turn), T{})), phi.cosine, phi.sine);
        // A sphere sends as much from all of its disc across the direction, from its far side on.
        T at[3] = {all<T>(e.lamp.at[0]), all<T>(e.lamp.at[1]), all<T>(e.lamp.at[2])};
        if (e.lamp.radius > 0.0f) {
            const Words<U<W>> w = threefry(k.key.k0, k.key.k1, number, all<U<W>>(kPlaceOnLamp));
            const T share = uniform(w.a);
            const SinCos<T> side = sincos_turns(uniform(w.b));
            const Vec<T> place =
                turned(d, sqrt_(1.0f - share), sqrt_(share), side.cosine, side.sine);
            at[0] = at[0] + place.x * e.lamp.radius;
            at[1] = at[1] + place.y * e.lamp.radius;
            at[2] = at[2] + place.z * e.lamp.radius;
        }
        // To the box: the farthest entry must lie before the nearest exit.
        T enter{}, leave = all<T>(3e38f);
        const T way[3] = {d.x, d.y, d.z};
        for (int a = 0; a < 3; ++a) {
            const T inverse = safe_inverse(way[a]);
            const T low = (0.0f - at[a]) * inverse;
            const T high = (float(k.grid.size[a]) * k.grid.cell[a] - at[a]) * inverse;
            enter = max_(enter, min_(low, high));
            leave = min_(leave, max_(low, high));
        }
        T p[3];
        for (int a = 0; a < 3; ++a)
            p[a] = min_(max_((at[a] + way[a] * enter) * (1.0f / k.grid.cell[a]), T{}),
                        all<T>(float(k.grid.size[a])));
        take({p[0], p[1], p[2]}, d);
        const M<W> past = mine & (enter >= leave);
        missed = missed | past;
        const T down = (k.ground_z - at[2]) * safe_inverse(d.z);
        s.ground_x = select(past, at[0] + d.x * down, s.ground_x);
        s.ground_y = select(past, at[1] + d.y * down, s.ground_y);
    }
    return start;
}

/// Offset from the middle of a voxel, voxels, of a place drawn by the voxel's weight in a trilinear
/// field: a tent over it and its neighbours; beyond the outermost middles the weight is whole.
PILEUS_FN float offset_in_tent(float u, bool first, bool last, bool constant) {
    if (constant) return u - 0.5f;
    // Either half of the tent, or in its stead the even half voxel to the face.
    if (u < 0.5f) return first ? u - 0.5f : sqrt_(2.0f * u) - 1.0f;
    return last ? u - 0.5f : 1.0f - sqrt_(2.0f - 2.0f * u);
}

/// Media: a voxel by its share of what they send out, a place around its middle, any direction.
template <int W>
PILEUS_FN Start<F<W>> start_in_medium(const TraceParams& k, U<W> index, M<W> m) {
    using T = F<W>;
    const U<W> number = index + k.first_photon, choice = index * kR2[0] + k.shift[0];
    const Words<U<W>> w = threefry(k.key.k0, k.key.k1, number, U<W>{});
    const Words<U<W>> more = threefry(k.key.k0, k.key.k1, number, all<U<W>>(kPlaceOnLamp));
    const T draws[3] = {uniform(w.a), uniform(w.b), uniform(more.a)};
    const T cosine = 1.0f - 2.0f * uniform(index * kR2[1] + k.shift[1]);
    const T sine = sqrt_(max_(1.0f - cosine * cosine, T{}));
    const SinCos<T> phi = sincos_turns(uniform(more.b));
    Start<T> start{{}, {sine * phi.cosine, sine * phi.sine, cosine}};
    const std::int32_t* n = k.grid.size;
    for (std::uint32_t lanes = bits_of(m); lanes != 0; lanes &= lanes - 1) {
        const int l = lowest_bit(lanes);
        // The last voxel that begins at or before the draw.
        const std::uint32_t drawn = lane(choice, l);
        std::int64_t low = 0, high = std::int64_t(n[0]) * n[1] * n[2];
        while (high - low > 1) {
            const std::int64_t middle = low + (high - low) / 2;
            if (k.emitted_below[middle] <= drawn)
                low = middle;
            else
                high = middle;
        }
        const std::int32_t at[3] = {std::int32_t(low % n[0]), std::int32_t(low / n[0] % n[1]),
                                    std::int32_t(low / n[0] / n[1])};
        float p[3];
        for (int a = 0; a < 3; ++a) {
            const bool open = k.grid.periodic == 0 || a == 2;
            p[a] = float(at[a]) + 0.5f +
                   offset_in_tent(lane(draws[a], l), open && at[a] == 0, open && at[a] == n[a] - 1,
                                  k.grid.constant != 0);
            if (!open && p[a] < 0.0f) p[a] = p[a] + float(n[a]);
            if (!open && p[a] > float(n[a])) p[a] = p[a] - float(n[a]);
            p[a] = min_(max_(p[a], 0.0f), float(n[a]));
        }
        set_lane(start.p.x, l, p[0]), set_lane(start.p.y, l, p[1]), set_lane(start.p.z, l, p[2]);
    }
    return start;
}

/// What a photon carries in channel `c` when it begins.
template <int W, int NC, bool S>
PILEUS_FN F<W> start_weight(const Photon<W, NC, S>& s, const TraceParams& k, int c) {
    if (NC > 1 && k.light == kLightMap) return texel_share(k.map, s.texel, c);
    F<W> weight = all<F<W>>(1.0f);
    if (NC > 1 && k.light == kLightLamps)
        for (std::int32_t l = 0; l < k.lamp_count; ++l) {
            const LampParams& lamp = k.lamps[l].lamp;
            weight = select(s.texel == l, all<F<W>>(lamp.light[c] / lamp.strength), weight);
        }
    return weight;
}

/// Begin photons `s.index` (numbered within the launch) in the lanes of `m`. Returns those of lamps
/// that miss the box.
template <int W, int NC, bool S>
PILEUS_FN M<W> start_photons(Photon<W, NC, S>& s, const TraceParams& k, M<W> m) {
    using T = F<W>;
    const T zero{};
    const U<W> number = s.index + k.first_photon;
    M<W> missed = m & lnot(m);
    const Start<T> start = k.light == kLightMedia   ? start_in_medium<W>(k, s.index, m)
                           : k.light == kLightMap   ? start_from_map<W>(k, s.index, s.texel, m)
                           : k.light == kLightLamps ? start_from_lamps(s, k, m, missed)
                                                    : start_on_faces<W>(k, s.index);
    set_position(s, k.grid, m, start.p);
    set_direction(s, k.grid, m, start.d);

    const Words<U<W>> w = threefry(k.key.k0, k.key.k1, number, all<U<W>>(1u));
    s.tau = select(m, free_flight(w.a, w.b), s.tau);
    for (int c = 0; c < NC; ++c) s.weight[c] = select(m, start_weight(s, k, c), s.weight[c]);
    s.path = select(m, zero, s.path);
    s.event = select(m, U<W>{}, s.event);
    s.order = select(m, I<W>{}, s.order);
    s.strayed = select(m, I<W>{}, s.strayed);
    s.enters = select(m, all<I<W>>(-1), s.enters);
    s.alive = s.alive | m;
    s.shadow = s.shadow & lnot(m);
    s.owes = s.owes & lnot(m);
    if constexpr (S) s.wall = select(m, all<T>(-1.0f), s.wall);
    return missed;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
