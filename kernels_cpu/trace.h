// SPDX-License-Identifier: Apache-2.0
// Photons through a heterogeneous medium: delta tracking on a grid of majorants.
// in: a range of photons of one light -> out: deposits in collectors and an exact energy ledger.
// docs/methods.md 2 (delta tracking, stochastic look-up) and 3, "Track" and "Store".
// Each lane carries one photon and takes the next when it dies; random numbers belong to
// (photon, event), so neither lanes nor threads can change a result.
#pragma once
#include "kernels_cpu/deposit.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <int W, int NC>
PILEUS_FN void count_fate(const Photon<W, NC>& s, std::int64_t (&plain)[3],
                          std::int64_t (&shadow)[3], std::uint32_t lanes) {
    const std::uint32_t dark = bits_of(s.shadow);
    for (; lanes != 0; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        std::int64_t(&bin)[3] = (dark >> i) & 1u ? shadow : plain;
        for (int c = 0; c < NC; ++c)
            bin[c] += NC == 1 ? kPhotonQuanta : quantise(lane(s.weight[c], i), 0x1p20f);
    }
}

/// Tally the lanes of `m` under the fate `name` of the light or of the ground's shadow.
#define PILEUS_FATE(s, tally, name, m) \
    count_fate(s, (tally).light.name, (tally).shadow.name, bits_of(m))

/// Add what the lanes of `m` bring to (ground_x, ground_y) to the map of the ground's light.
template <int W, int NC>
PILEUS_FN void light_ground(const Photon<W, NC>& s, const TraceParams& k, const TraceBuffers& b,
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
        const int i = __builtin_ctz(lanes);
        std::int64_t* cell =
            b.ground + (std::int64_t(lane(y, i)) * k.ground_cells[0] + lane(x, i)) * NC;
        for (int c = 0; c < NC; ++c) {
            const std::int32_t quanta = quantise(lane(s.weight[c], i), k.scale);
            add_sum(cell + c, (dark >> i) & 1u ? -quanta : quanta, b.shared_sums != 0);
        }
    }
}

/// Ground: absorb or reflect the lanes of `m` that arrive at (ground_x, ground_y).
template <int W, int NC>
PILEUS_FN void bounce(Photon<W, NC>& s, const TraceParams& k, TraceTally& tally, M<W> m) {
    using T = F<W>;
    tally.bounces += count_bits(bits_of(m));
    s.event = select(m, s.event + 1u, s.event);
    s.order = select(m, s.order + 1, s.order);
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
    const Vec<T> d{up.a, up.b, max_(up.normal, all<T>(k.grid.periodic != 0 ? kLeastSlope : 1e-6f))};
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
    const auto hit = kept & (enter < leave);
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
    set_direction(s, k.grid, hit, d);
    set_position(s, k.grid, hit,
                 Vec<T>{inside(s.ground_x + d.x * enter, k.grid.cell[0], k.grid.size[0]),
                        inside(s.ground_y + d.y * enter, k.grid.cell[1], k.grid.size[1]),
                        min_(max_((k.ground_z + d.z * enter) * (1.0f / k.grid.cell[2]), T{}),
                             all<T>(float(k.grid.size[2])))});
    s.tau = select(hit, free_flight(first.b, first.a), s.tau);
}

/// Where the straight ray of a lane that travels down meets the ground: metres along `axis`.
template <int W, int NC>
PILEUS_FN F<W> ground_place(const Photon<W, NC>& s, const TraceParams& k, int axis) {
    const F<W> t = (s.p.z * k.grid.cell[2] - k.ground_z) * (F<W>{} - safe_inverse(s.d.z));
    const float cell = k.grid.cell[axis];
    const F<W> place = axis == 0 ? s.p.x * cell + s.d.x * t : s.p.y * cell + s.d.y * t;
    return k.grid.periodic != 0 ? wrap_place(place, float(k.grid.size[axis]) * cell) : place;
}

/// Lanes of `m` have left the box: tally them, or send them to the ground.
template <int W, int NC>
PILEUS_FN void leave_box(Photon<W, NC>& s, const TraceParams& k, const TraceBuffers& b, M<W> m,
                         M<W> by_z) {
    TraceTally& tally = *b.tally;
    auto down = m & lnot(m);
    if (k.ground != 0) {
        // Unscattered light is part of the unshadowed ground's radiance already.
        down = m & (s.d.z < 0.0f) & (s.order > 0);
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
        if (k.ground_cells[0] > 0) light_ground(s, k, b, down);
        bounce(s, k, tally, down);
    }
}

/// Real collisions with the media named, in the lanes of `m`: absorb by roulette, otherwise turn.
template <int W, int NC>
PILEUS_FN void scatter(Photon<W, NC>& s, const TraceParams& k, const TraceBuffers& b, M<W> m,
                       U<W> spare, I<W> medium) {
    using T = F<W>;
    TraceTally& tally = *b.tally;
    tally.scatterings += count_bits(bits_of(m));
    if (k.ground != 0) {
        // Straight down-going light that the ground will miss: remember where.
        const auto owing = m & (s.order == 0) & (s.d.z < 0.0f) & lnot(s.shadow);
        s.owed_x = select(owing, ground_place(s, k, 0), s.owed_x);
        s.owed_y = select(owing, ground_place(s, k, 1), s.owed_y);
        s.owes = s.owes | owing;
    }
    // White media absorb nothing: do not ask.
    float least = k.optics[0].albedo_max;
    for (int i = 1; i < k.media; ++i)
        least = k.optics[i].albedo_max < least ? k.optics[i].albedo_max : least;
    if (least < 1.0f) {
        tally.absorption_tests += count_bits(bits_of(m));
        T survival = all<T>(k.optics[0].albedo_max);
        for (int i = 1; i < k.media; ++i)
            survival = select(medium == i, all<T>(k.optics[i].albedo_max), survival);
        const auto absorbed = m & (uniform(spare) >= survival);
        if (any(absorbed)) {
            PILEUS_FATE(s, tally, absorbed, absorbed);
            s.alive = s.alive & lnot(absorbed);
            m = m & lnot(absorbed);
            if (!any(m)) return;
        }
    }
    s.order = select(m, s.order + 1, s.order);
    if constexpr (NC > 1) {
        for (std::uint32_t lanes = bits_of(m); lanes != 0; lanes &= lanes - 1) {
            const int i = __builtin_ctz(lanes);
            const bool dark = (bits_of(s.shadow) >> i) & 1u;
            Fates& fates = dark ? tally.shadow : tally.light;
            const Optics& optics = k.optics[lane(medium, i)];
            for (int c = 0; c < NC; ++c) {
                const float before = lane(s.weight[c], i);
                const float after = before * (optics.albedo[c] / optics.albedo_max);
                fates.absorbed[c] += quantise(before, 0x1p20f) - quantise(after, 0x1p20f);
                set_lane(s.weight[c], i, after);
            }
        }
    }
    const Words<U<W>> w = threefry(k.key.k0, k.key.k1, s.index + k.first_photon, s.event * 4u + 2u);
    const T u = uniform_open(w.a);
    Turn<T> turn = phase_sample(k.optics[0].phase, u);
    for (int i = 1; i < k.media; ++i) {
        const auto mine = m & (medium == i);
        if (!any(mine)) continue;
        const Turn<T> other = phase_sample(k.optics[i].phase, u);
        turn.one_minus_cos = select(mine, other.one_minus_cos, turn.one_minus_cos);
        turn.sine = select(mine, other.sine, turn.sine);
    }
    const SinCos<T> phi = sincos_turns(uniform(w.b));
    set_direction(s, k.grid, m,
                  turned(s.d, 1.0f - turn.one_minus_cos, turn.sine, phi.cosine, phi.sine));
}

/// Groups of lanes in flight: one leaves them waiting for memory (1.8 times the time on a cloud of
/// 22 MB), from three on there is nothing more to gain.
constexpr int kGroups = 3;

/// A photon per lane, and the tentative collision that each has come to.
template <int W, int NC>
struct Group {
    Photon<W, NC> s;
    M<W> before, hits;   // alive at the start of the turn; arrived at a collision
    F<W> bound;          // majorant there
    I<W> corner, voxel;  // the look-up's voxel; the one that holds the photon
    U<W> spare;          // random bits left over from choosing the corner
};

/// Ask for the memory that the lanes of `m` will read, so that it comes while others compute.
template <int W>
PILEUS_FN void fetch_ahead(const float* density, const std::int32_t* collectors, std::uint32_t m,
                           I<W> corner, I<W> voxel, const float* parts) {
    for (; m != 0; m &= m - 1) {
        const int i = __builtin_ctz(m);
        __builtin_prefetch(density + lane(corner, i));
        if (parts != nullptr) __builtin_prefetch(parts + lane(corner, i));
        if (collectors != nullptr) __builtin_prefetch(collectors + lane(voxel, i));
    }
}

/// Move every living lane to its next collision or block border.
template <int W, int NC>
PILEUS_FN void advance(Group<W, NC>& g, const TraceParams& k, const TraceBuffers& b) {
    Photon<W, NC>& s = g.s;
    g.before = s.alive;
    const Stride<W> m = stride(s, k.grid, k.grid.majorant, s.alive);
    g.hits = m.hits;
    g.bound = m.bound;
    s.path = s.path + select(s.alive, m.metres, F<W>{});
    if (any(m.hops)) {
        b.tally->crossings += count_bits(bits_of(m.hops));
        const Crossing<W> c = cross(s, k.grid, m);
        if (any(c.out)) leave_box(s, k, b, c.out, c.by_z);
    }
    if (!any(m.hits)) return;
    b.tally->tentative += count_bits(bits_of(m.hits));
    s.event = select(m.hits, s.event + 1u, s.event);
    const Words<U<W>> w = threefry(k.key.k0, k.key.k1, s.index + k.first_photon, s.event * 4u + 1u);
    // One look-up stands for eight: acceptance is linear in density.
    g.corner = select(m.hits, corner_voxel(s.p, w.a, k.grid), I<W>{});
    g.voxel = select(m.hits, voxel_of(s.p, k.grid), I<W>{});
    g.spare = w.b;
    fetch_ahead<W>(k.grid.density, k.mode != kDepositNone ? b.collector : nullptr, bits_of(m.hits),
                   g.corner, g.voxel, k.media > 1 ? b.parts : nullptr);
}

/// Tentative collisions in the lanes that have come to one.
template <int W, int NC>
PILEUS_FN void collide(Group<W, NC>& g, const TraceParams& k, const TraceBuffers& b) {
    using T = F<W>;
    Photon<W, NC>& s = g.s;
    const Words<U<W>> flight = threefry(k.key.k0, k.key.k1, s.index + k.first_photon, s.event * 4u);
    const T density = gather(k.grid.density, g.corner);
    const auto over = g.hits & (density > g.bound);
    if (any(over)) b.tally->majorant_violations += count_bits(bits_of(over));

    const auto medium = g.hits & (density > 0.0f);
    if (k.mode != kDepositNone && k.mode != kDepositOutgoing && any(medium))
        deposit(k, b, s, medium, g.voxel, density / g.bound, g.corner, density);
    s.tau = select(g.hits, free_flight(flight.a, g.spare), s.tau);
    const T level = uniform(flight.b) * g.bound;
    const auto real = medium & (level < density);
    if (any(real)) {
        // Below the density the level is uniform still: it falls to each medium by its share.
        const I<W> whose = k.media > 1
                               ? medium_under(b.parts, voxels_of(k.grid), k.media, g.corner, level)
                               : I<W>{};
        scatter(s, k, b, real, g.spare, whose);
        if (k.mode == kDepositOutgoing)
            deposit(k, b, s, real & s.alive, g.voxel, all<T>(1.0f), g.corner, density);
    }

    const auto tired = g.hits & s.alive & (s.event >= k.grid.max_events);
    if (any(tired)) {
        PILEUS_FATE(s, *b.tally, terminated, tired);
        s.alive = s.alive & lnot(tired);
    }
}

/// Photons that died may owe the ground's missing light: send it up as a negative photon.
template <int W, int NC>
PILEUS_FN void settle(Photon<W, NC>& s, const TraceParams& k, const TraceBuffers& b, M<W> died) {
    TraceTally& tally = *b.tally;
    for (std::uint32_t lanes = bits_of(died); lanes != 0; lanes &= lanes - 1)
        tally.path += quantise(lane(s.path, __builtin_ctz(lanes)), k.path_scale);
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
    for (int c = 0; c < NC; ++c) s.weight[c] = select(owing, start_weight(s, k, c), s.weight[c]);
    PILEUS_FATE(s, tally, emitted, owing);
    // The sun's own shadow on the ground is drawn sharply by the display.
    if (k.ground_cells[0] > 0 && k.light != kLightBeam) light_ground(s, k, b, owing);
    bounce(s, k, tally, owing);
}

/// Give idle lanes the next photons once a quarter is idle: results belong to photons, so the
/// moment is free. Returns whether any lane lives.
template <int W, int NC>
PILEUS_FN bool refill(Photon<W, NC>& s, const TraceParams& k, const TraceBuffers& b,
                      std::uint32_t& next, std::uint32_t end) {
    constexpr std::uint32_t kFull = (1u << W) - 1u;
    const std::uint32_t living = bits_of(s.alive), idle = ~living & kFull;
    if (next >= end || (living != 0 && count_bits(idle) * 4 < W)) return living != 0;
    const U<W> numbers = reinterpret<U<W>>(iota<I<W>>());
    auto fresh = s.alive & lnot(s.alive);
    for (std::uint32_t lanes = idle; lanes != 0 && next < end; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        set_lane(s.index, i, next++);
        fresh = fresh | (numbers == std::uint32_t(i));
    }
    start_photons(s, k, fresh);
    b.tally->photons += count_bits(bits_of(fresh));
    PILEUS_FATE(s, *b.tally, emitted, fresh);
    return true;
}

/// Trace photons [begin, end) of the launch, several groups of lanes in turn: while the memory of
/// one is on its way the others compute.
template <int W, int NC>
PILEUS_FN void trace_photons(const TraceParams& k, const TraceBuffers& b, std::uint32_t begin,
                             std::uint32_t end) {
    Group<W, NC> groups[kGroups] = {};
    for (Group<W, NC>& g : groups) {
        g.s.p = {all<F<W>>(0.5f), all<F<W>>(0.5f), all<F<W>>(0.5f)};
        g.s.d.z = g.s.inverse.x = g.s.inverse.y = g.s.inverse.z = all<F<W>>(1.0f);
    }
    std::uint32_t next = begin;
    for (bool busy = true; busy;) {
        busy = false;
        for (Group<W, NC>& g : groups) {
            busy |= refill(g.s, k, b, next, end);
            advance(g, k, b);
        }
        for (Group<W, NC>& g : groups) {
            if (any(g.hits)) collide(g, k, b);
            const auto died = g.before & lnot(g.s.alive);
            if (any(died)) settle(g.s, k, b, died);
        }
    }
}
#undef PILEUS_FATE

template <int W>
PILEUS_FN void trace(const TraceParams& k, const TraceBuffers& b, std::uint32_t begin,
                     std::uint32_t end) {
    if (k.channels == 1)
        trace_photons<W, 1>(k, b, begin, end);
    else
        trace_photons<W, 3>(k, b, begin, end);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
