// SPDX-License-Identifier: Apache-2.0
// How photons end: out of the box, on the ground or given up; and what the ground sends back.
// in: lanes that have come to a border -> out: the ledger's fates, the ground's light, new flights.
// docs/methods.md 3, "Ground" and "Track"; fates are whole quanta, so that their sums are exact.
#pragma once
#include "kernels_cpu/core/accumulate.h"
#include "kernels_cpu/core/fixed.h"
#include "kernels_cpu/photons/meter.h"
#include "kernels_cpu/photons/meters.h"
#include "kernels_cpu/photons/trace_walk.h"
#include "kernels_cpu/solids/solids.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <int W, int NC, bool S>
PILEUS_FN void count_fate(const Photon<W, NC, S>& s, std::int64_t (&plain)[3],
                          std::int64_t (&shadow)[3], std::uint32_t lanes) {
    const std::uint32_t dark = bits_of(s.shadow);
    if constexpr (NC == 1) {
        shadow[0] += kPhotonQuanta * count_bits(lanes & dark);
        plain[0] += kPhotonQuanta * count_bits(lanes & ~dark);
    } else {
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = lowest_bit(lanes);
            std::int64_t(&bin)[3] = (dark >> i) & 1u ? shadow : plain;
            for (int c = 0; c < NC; ++c) bin[c] += quantise(lane(s.weight[c], i), 0x1p20f);
        }
    }
}

/// Tally the lanes of `m` under the fate `name` of the light or of the ground's shadow.
#define PILEUS_FATE(s, tally, name, m) \
    count_fate(s, (tally).light.name, (tally).shadow.name, bits_of(m))

/// Add what the lanes of `m` bring to (ground_x, ground_y) to the map of the ground's light.
template <int W, int NC, bool S>
PILEUS_FN void light_ground(const Photon<W, NC, S>& s, const TraceParams& k, const TraceBuffers& b,
                            M<W> m) {
    // Light that grazes arrives farther away than whole numbers reach: stop it just off the map.
    const auto cell_at = [&](F<W> at, int a) {
        const F<W> place = (at - k.ground_origin[a]) * k.ground_cells_per_metre[a];
        return floor_int(max_(min_(place, all<F<W>>(float(k.ground_cells[a]))), all<F<W>>(-1.0f)));
    };
    const auto x = cell_at(s.ground_x, 0), y = cell_at(s.ground_y, 1);
    const auto known = m & (x >= 0) & (x < k.ground_cells[0]) & (y >= 0) & (y < k.ground_cells[1]);
    const std::uint32_t dark = bits_of(s.shadow);
    for (std::uint32_t lanes = bits_of(known); lanes != 0; lanes &= lanes - 1) {
        const int i = lowest_bit(lanes);
        std::int64_t* cell =
            b.ground + (std::int64_t(lane(y, i)) * k.ground_cells[0] + lane(x, i)) * NC;
        for (int c = 0; c < NC; ++c) {
            const std::int32_t quanta = quantise(lane(s.weight[c], i), k.scale);
            add_sum(cell + c, (dark >> i) & 1u ? -quanta : quanta, b.shared_sums != 0);
        }
    }
}

/// Photons of the lanes of `m` that a solid keeps from the box, which they reach from the ground
/// after `enter` metres along `d`: they end there.
template <int W, int NC, bool S>
PILEUS_FN M<W> hidden_from_box(Photon<W, NC, S>& s, const TraceParams& k, TraceTally& tally, M<W> m,
                               const Vec<F<W>>& d, F<W> enter) {
    const Vec<F<W>> ground{s.ground_x, s.ground_y, all<F<W>>(k.ground_z)};
    const M<W> hidden = behind_solids(k.solids, ground, d, max_(enter, F<W>{}), m);
    if (!any(hidden)) return hidden;
    PILEUS_FATE(s, tally, solid, hidden);
    s.alive = s.alive & lnot(hidden);
    return hidden;
}

/// Ground: absorb or reflect the lanes of `m` that arrive at (ground_x, ground_y).
template <int W, int NC, bool S>
PILEUS_FN void bounce(Photon<W, NC, S>& s, const TraceParams& k, TraceTally& tally, M<W> m) {
    using T = F<W>;
    tally.bounces += count_bits(bits_of(m));
    s.event = select(m, s.event + 1u, s.event);
    s.order = select(m, s.order + 1, s.order);
    s.strayed = select(m, all<I<W>>(1), s.strayed);
    const U<W> number = s.index + k.first_photon, at = s.event * 4u;
    const Words<U<W>> first = threefry(k.key.k0, k.key.k1, number, at + 2u);
    const Lambert<T> up = lambert(threefry(k.key.k0, k.key.k1, number, at + 3u));
    const auto kept = m & (uniform(first.a) < k.ground_albedo);
    const auto lost = m & lnot(kept);
    if (any(lost)) {
        PILEUS_FATE(s, tally, ground, lost);
        s.alive = s.alive & lnot(lost);
    }
    if (!any(kept)) return;

    // Follow the reflected ray to the box: the farthest entry must lie before the nearest exit.
    const Vec<T> d{up.a, up.b, max_(up.normal, all<T>(k.grid.periodic != 0 ? kMinSlope : 1e-6f))};
    const Vec<T> inverse{safe_inverse(d.x), safe_inverse(d.y), safe_inverse(d.z)};
    const float ex = float(k.grid.size[0]) * k.grid.cell[0],
                ey = float(k.grid.size[1]) * k.grid.cell[1],
                ez = float(k.grid.size[2]) * k.grid.cell[2];
    const T ax = (T{} - s.ground_x) * inverse.x, bx = (ex - s.ground_x) * inverse.x;
    const T ay = (T{} - s.ground_y) * inverse.y, by = (ey - s.ground_y) * inverse.y;
    const T enter_z = (0.0f - k.ground_z) * inverse.z, leave_z = (ez - k.ground_z) * inverse.z;
    // A periodic medium is met by every ray, at its lower face.
    const bool wraps = k.grid.periodic != 0;
    const T enter = wraps ? enter_z : max_(max_(min_(ax, bx), min_(ay, by)), enter_z);
    const T leave = wraps ? leave_z : min_(min_(max_(ax, bx), max_(ay, by)), leave_z);
    auto hit = kept & (enter < leave);
    const auto gone = kept & lnot(hit);
    if (any(gone)) {
        PILEUS_FATE(s, tally, sky, gone);
        s.alive = s.alive & lnot(gone);
    }
    if (!any(hit)) return;
    const auto inside = [&](T metres, float cell, std::int32_t n) {
        const T place = wraps ? wrap_place(metres, float(n) * cell) : metres;
        return min_(max_(place * (1.0f / cell), T{}), all<T>(float(n)));
    };
    if constexpr (S) hit = hit & lnot(hidden_from_box(s, k, tally, hit, d, enter));
    s.enters = select(hit, all<I<W>>(-1), s.enters);
    if constexpr (S) s.wall = select(hit, all<T>(-1.0f), s.wall);
    set_direction(s, k.grid, hit, d);
    set_position(s, k.grid, hit,
                 Vec<T>{inside(s.ground_x + d.x * enter, k.grid.cell[0], k.grid.size[0]),
                        inside(s.ground_y + d.y * enter, k.grid.cell[1], k.grid.size[1]),
                        min_(max_((k.ground_z + d.z * enter) * (1.0f / k.grid.cell[2]), T{}),
                             all<T>(float(k.grid.size[2])))});
    s.tau = select(hit, free_flight(first.b, first.a), s.tau);
}

/// Lanes whose straight light the ground has already: that of all but lamps with a place, and
/// media.
template <int W, int NC, bool S>
PILEUS_FN M<W> known_to_ground(const Photon<W, NC, S>& s, const TraceParams& k) {
    M<W> known = s.order == 0;
    if (k.light == kLightMedia) return known & lnot(known);
    if (k.light != kLightLamps) return known;
    for (std::int32_t l = 0; l < k.lamp_count; ++l)
        if (k.lamps[l].lamp.parallel == 0) known = known & (s.texel != l);
    return known;
}

/// Photons of lamps that miss the box: what meets the ground there may yet come to it.
template <int W, int NC, bool S>
PILEUS_FN void miss_box(Photon<W, NC, S>& s, const TraceParams& k, TraceTally& tally, M<W> m) {
    M<W> down = m & lnot(m);
    if (k.ground != 0) down = m & (s.d.z < 0.0f);
    const M<W> gone = m & lnot(down);
    if (any(gone)) PILEUS_FATE(s, tally, sky, gone);
    s.alive = s.alive & lnot(gone);
    if (any(down)) bounce(s, k, tally, down);
}

/// Where the straight ray of a lane that travels down meets the ground: metres along `axis`.
template <int W, int NC, bool S>
PILEUS_FN F<W> ground_place(const Photon<W, NC, S>& s, const TraceParams& k, int axis) {
    const F<W> t = (s.p.z * k.grid.cell[2] - k.ground_z) * (F<W>{} - safe_inverse(s.d.z));
    const float cell = k.grid.cell[axis];
    const F<W> place = axis == 0 ? s.p.x * cell + s.d.x * t : s.p.y * cell + s.d.y * t;
    return k.grid.periodic != 0 ? wrap_place(place, float(k.grid.size[axis]) * cell) : place;
}

/// Lanes of `m` have left the box: tally them, or send them to the ground.
template <int W, int NC, bool S>
PILEUS_FN void leave_box(Photon<W, NC, S>& s, const TraceParams& k, const TraceBuffers& b, M<W> m,
                         M<W> by_z) {
    TraceTally& tally = *b.tally;
    if (is_metered(k)) {
        const M<W> up = s.inverse.z > 0.0f;
        meter_exits(s, k, b, m & by_z & up, m & by_z & lnot(up));
    }
    auto down = m & lnot(m);
    if (k.ground != 0) {
        // Unscattered light is part of the unshadowed ground's radiance already.
        const M<W> known = known_to_ground(s, k);
        down = m & (s.d.z < 0.0f) & lnot(known);
        if constexpr (S) {
            // A solid in the way, outside of the box: it is black to what comes from there.
            const F<W> way = (s.p.z * k.grid.cell[2] - k.ground_z) * (F<W>{} - safe_inverse(s.d.z));
            const M<W> stopped = down & (s.wall >= 0.0f) & (s.wall < way);
            if (any(stopped)) PILEUS_FATE(s, tally, solid, stopped);
            s.alive = s.alive & lnot(stopped);
            down = down & lnot(stopped);
            m = m & lnot(stopped);
        }
        s.ground_x = select(down, ground_place(s, k, 0), s.ground_x);
        s.ground_y = select(down, ground_place(s, k, 1), s.ground_y);
    }
    const auto out = m & lnot(down);
    if (any(out)) {
        const auto top = out & by_z & (s.inverse.z > 0.0f), bottom = out & by_z & lnot(top);
        const auto sides = out & lnot(by_z);
        PILEUS_FATE(s, tally, top, top);
        PILEUS_FATE(s, tally, bottom, bottom);
        PILEUS_FATE(s, tally, sides, sides);
        PILEUS_FATE(s, tally, direct_bottom, bottom & (s.order == 0));
        s.alive = s.alive & lnot(out);
    }
    if (any(down)) {
        // What lamps send straight is the display's.
        const M<W> mapped = k.light == kLightMedia ? down : down & (s.order > 0);
        if (k.ground_cells[0] > 0) light_ground(s, k, b, mapped);
        bounce(s, k, tally, down);
    }
}

/// Photons that died may owe the ground's missing light: send it up as a negative photon.
template <int W, int NC, bool S>
PILEUS_FN void settle(Photon<W, NC, S>& s, const TraceParams& k, const TraceBuffers& b, M<W> died) {
    TraceTally& tally = *b.tally;
    for (std::uint32_t lanes = bits_of(died); lanes != 0; lanes &= lanes - 1)
        tally.path += quantise(lane(s.path, lowest_bit(lanes)), k.path_scale);
    if (k.ground == 0) return;
    const auto owing = died & s.owes;
    if (!any(owing)) return;
    s.owes = s.owes & lnot(owing);
    s.shadow = s.shadow | owing;
    s.alive = s.alive | owing;
    s.path = select(owing, F<W>{}, s.path);
    // The photon's own bounces moved ground_x and ground_y: start where the straight ray ends.
    s.ground_x = select(owing, s.owed_x, s.ground_x);
    s.ground_y = select(owing, s.owed_y, s.ground_y);
    for (int c = 0; c < NC; ++c)
        s.weight[c] = select(owing, start_weight(s, k, c) * (1.0f - k.unowed[c]), s.weight[c]);
    PILEUS_FATE(s, tally, emitted, owing);
    // Shadows of sun and lamps on the ground are drawn sharply by the display.
    const bool sharp = k.light == kLightBeam || k.light == kLightLamps;
    if (k.ground_cells[0] > 0 && !sharp) light_ground(s, k, b, owing);
    bounce(s, k, tally, owing);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
