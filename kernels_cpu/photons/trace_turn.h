// SPDX-License-Identifier: Apache-2.0
// Real collisions: who survives, and the new directions, computed a full vector at a time.
// in: lanes at a real collision -> out: photons turned, and for the paper what they scatter.
// docs/methods.md 3, "Track" and "Queues".
// A lane that waits for its new direction stands still; its random numbers do not depend on when.
#pragma once
#include "kernels_cpu/photons/deposit.h"
#include "kernels_cpu/photons/trace_ends.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// A photon per lane, and the tentative collision that each has come to.
template <int W, int NC, bool S>
struct Group {
    Photon<W, NC, S> s;
    I<W> waits;          // -1: in the queue for a new direction
    M<W> holds;          // carries a photon whose end is not yet booked
    M<W> out, by_z;      // stands outside of the box; which it left through top or bottom
    M<W> hits;           // has come to a tentative collision
    I<W> corner, voxel;  // the look-up's voxel; the one that holds the photon
    U<W> draw;           // decides it
};

/// Photons that wait for a new direction, wherever their lanes are.
template <int W, int NC, bool S>
struct TurnQueue {
    static constexpr int kRoom = (kGroups + 2) * W;
    float x[kRoom], y[kRoom], z[kRoom];         // direction before
    std::uint32_t photon[kRoom], event[kRoom];  // what the random numbers belong to
    std::int32_t medium[kRoom];
    std::int32_t place[kRoom];  // group * W + lane; -1: ended there
    float share[NC][kRoom];     // paper only: signed weight to deposit,
    std::int32_t voxel[kRoom];  // and where
    std::int32_t count;
};

/// Rare events that wait until a whole vector of them has come together.
template <int W, int NC, bool S>
struct Queues {
    TurnQueue<W, NC, S> turns;
    DepositQueue<W, NC> deposits;
};

/// Random numbers of the lanes' present events: 0 absorption, 1 corner and collision, 2 direction,
/// 3 free flight.
template <int W, int NC, bool S>
PILEUS_FN Words<U<W>> draw(const Photon<W, NC, S>& s, const TraceParams& k, std::uint32_t number) {
    return threefry(k.key.k0, k.key.k1, s.index + k.first_photon, s.event * 4u + number);
}

/// Absorbs lanes of `m` by roulette: returns those that survive. One draw serves all channels.
template <int W, int NC, bool S>
PILEUS_FN M<W> survive(Photon<W, NC, S>& s, const TraceParams& k, TraceTally& tally, M<W> m,
                       I<W> medium) {
    // White media absorb nothing: do not ask.
    float least = k.optics[0].albedo_max;
    for (int i = 1; i < k.media; ++i)
        least = k.optics[i].albedo_max < least ? k.optics[i].albedo_max : least;
    if (!(least < 1.0f)) return m;
    tally.absorption_tests += count_bits(bits_of(m));
    F<W> survival = all<F<W>>(k.optics[0].albedo_max);
    for (int i = 1; i < k.media; ++i)
        survival = select(medium == i, all<F<W>>(k.optics[i].albedo_max), survival);
    const auto absorbed = m & (uniform(draw(s, k, 0u).a) >= survival);
    if (any(absorbed)) {
        PILEUS_FATE(s, tally, absorbed, absorbed);
        s.alive = s.alive & lnot(absorbed);
    }
    return m & lnot(absorbed);
}

/// Takes from the weights of the lanes of `m` what the medium absorbs of their colours.
template <int W, int NC, bool S>
PILEUS_FN void colour(Photon<W, NC, S>& s, const TraceParams& k, TraceTally& tally, M<W> m,
                      I<W> medium) {
    for (std::uint32_t lanes = bits_of(m); lanes != 0; lanes &= lanes - 1) {
        const int i = lowest_bit(lanes);
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

/// Real collisions with the media named, in the lanes of `m` of group number `group`: absorb by
/// roulette, and let the others wait for a new direction.
template <int W, int NC, bool S>
PILEUS_FN void scatter(Group<W, NC, S>& g, const TraceParams& k, const TraceBuffers& b,
                       TurnQueue<W, NC, S>& q, int group, M<W> m, I<W> medium) {
    Photon<W, NC, S>& s = g.s;
    TraceTally& tally = *b.tally;
    tally.scatterings += count_bits(bits_of(m));
    if (k.ground != 0) {
        // Straight down-going light that the ground will miss: remember where.
        const M<W> known = known_to_ground(s, k);
        const auto owing = m & known & (s.d.z < 0.0f) & lnot(s.shadow);
        s.owed_x = select(owing, ground_place(s, k, 0), s.owed_x);
        s.owed_y = select(owing, ground_place(s, k, 1), s.owed_y);
        s.owes = s.owes | owing;
    }
    m = survive(s, k, tally, m, medium);
    const std::uint32_t bits = bits_of(m);
    if (bits == 0) return;
    s.order = select(m, s.order + 1, s.order);
    if constexpr (NC > 1) colour(s, k, tally, m, medium);

    // A photon that is given up here still scatters its last light, but flies no further.
    const auto ends = m & (s.event >= k.grid.max_events);
    const std::int32_t at = q.count;
    q.count += count_bits(bits);
    pack(q.x + at, s.d.x, bits), pack(q.y + at, s.d.y, bits), pack(q.z + at, s.d.z, bits);
    pack(q.photon + at, s.index + k.first_photon, bits);
    pack(q.event + at, s.event, bits);
    if (k.media > 1) pack(q.medium + at, medium, bits);
    pack(q.place + at, select(ends, all<I<W>>(-1), iota<I<W>>() + group * W), bits);
    g.waits = select(m & lnot(ends), all<I<W>>(-1), g.waits);
    if (k.mode != kDepositOutgoing) return;
    for (int c = 0; c < NC; ++c) {
        F<W> share = select(s.shadow, F<W>{} - s.weight[c], s.weight[c]);
        // The display marches what lamps send straight.
        if (k.light == kLightLamps) share = select(s.order == 1, F<W>{}, share);
        pack(q.share[c] + at, share, bits);
    }
    pack(q.voxel + at, voxel_of(s.p, k.grid), bits);
    for (std::int32_t i = at; i < q.count; ++i) prefetch_(b.collector + q.voxel[i]);
}

/// New directions of items [at, at + W) of the queue, or of its last few; `strays`: which turn by
/// more than their beam keeps.
template <int W, int NC, bool S>
PILEUS_FN Vec<F<W>> turned_items(const TraceParams& k, const TurnQueue<W, NC, S>& q,
                                 std::int32_t at, M<W>& strays) {
    using T = F<W>;
    const Words<U<W>> w =
        threefry(k.key.k0, k.key.k1, load<U<W>>(q.photon + at), load<U<W>>(q.event + at) * 4u + 2u);
    const T u = uniform_open(w.a);
    Turn<T> turn = phase_sample(k.optics[0].phase, u);
    for (int i = 1; i < k.media; ++i) {
        const auto mine = load<I<W>>(q.medium + at) == i;
        if (!any(mine)) continue;
        const Turn<T> other = phase_sample(k.optics[i].phase, u);
        turn.one_minus_cos = select(mine, other.one_minus_cos, turn.one_minus_cos);
        turn.sine = select(mine, other.sine, turn.sine);
    }
    strays = turn.one_minus_cos >= 0.0f;
    if (k.peak_turn > 0.0f) {
        // The bits that neither of the two numbers above has used.
        const T chance = to_float(reinterpret<I<W>>(((w.a & 255u) << 8) | (w.b & 255u)));
        strays = chance >= 65536.0f * exp_(T{} - turn.one_minus_cos * (1.0f / k.peak_turn));
    }
    const SinCos<T> phi = sincos_turns(uniform(w.b));
    const Vec<T> d{load<T>(q.x + at), load<T>(q.y + at), load<T>(q.z + at)};
    return turned(d, 1.0f - turn.one_minus_cos, turn.sine, phi.cosine, phi.sine);
}

/// One number of a group's lanes, in memory.
template <class T, class S>
PILEUS_FN void put(T& lanes, int i, S value) {
    reinterpret_cast<S*>(&lanes)[i] = value;
}

/// Turns items [at, at + W) of the queue, or its last few, and lets their lanes go on.
template <int W, int NC, bool S>
PILEUS_FN void turn_items(Group<W, NC, S>* groups, const TraceParams& k, const TraceBuffers& b,
                          const TurnQueue<W, NC, S>& q, std::int32_t at,
                          DepositQueue<W, NC>& sums) {
    using T = F<W>;
    const std::int32_t items = q.count - at < W ? q.count - at : W;
    Walker<W> w{};
    const Words<U<W>> flight =
        threefry(k.key.k0, k.key.k1, load<U<W>>(q.photon + at), load<U<W>>(q.event + at) * 4u + 3u);
    w.tau = free_flight(flight.a, flight.b);
    M<W> strays{};
    set_direction(w, k.grid, iota<I<W>>() < items, turned_items(k, q, at, strays));
    const std::uint32_t stray_lanes = bits_of(strays);
    for (std::int32_t i = 0; i < items; ++i) {
        const std::int32_t place = q.place[at + i];
        if (place < 0) continue;
        Group<W, NC, S>& g = groups[place / W];
        const int l = place % W;
        put(g.s.d.x, l, lane(w.d.x, i)), put(g.s.inverse.x, l, lane(w.inverse.x, i));
        put(g.s.d.y, l, lane(w.d.y, i)), put(g.s.inverse.y, l, lane(w.inverse.y, i));
        put(g.s.d.z, l, lane(w.d.z, i)), put(g.s.inverse.z, l, lane(w.inverse.z, i));
        put(g.s.tau, l, lane(w.tau, i));
        put(g.s.enters, l, std::int32_t{-1});
        if constexpr (S) put(g.s.wall, l, -1.0f);
        if ((stray_lanes >> i) & 1u) put(g.s.strayed, l, std::int32_t{1});
        put(g.waits, l, std::int32_t{0});
    }
    if (k.mode != kDepositOutgoing) return;
    const I<W> collector = gather(b.collector, load<I<W>>(q.voxel + at));
    T share[NC];
    for (int c = 0; c < NC; ++c) share[c] = load<T>(q.share[c] + at);
    push_deposits(sums, w.d, (iota<I<W>>() < items) & (collector >= 0), collector, share);
}

/// Turns all that wait but a last few, less than half a vector, unless they are to go as well.
template <int W, int NC, bool S>
PILEUS_FN void turn_queued(Group<W, NC, S>* groups, const TraceParams& k, const TraceBuffers& b,
                           Queues<W, NC, S>& queues, bool last) {
    TurnQueue<W, NC, S>& q = queues.turns;
    std::int32_t at = 0;
    for (; q.count - at >= (last ? 1 : W); at += W)
        turn_items(groups, k, b, q, at, queues.deposits);
    if (at == 0) return;
    const std::int32_t left = q.count > at ? q.count - at : 0;
    for (std::int32_t i = 0; i < left; ++i) {
        q.x[i] = q.x[at + i], q.y[i] = q.y[at + i], q.z[i] = q.z[at + i];
        q.photon[i] = q.photon[at + i], q.event[i] = q.event[at + i];
        q.medium[i] = q.medium[at + i], q.place[i] = q.place[at + i];
        for (int c = 0; c < NC; ++c) q.share[c][i] = q.share[c][at + i];
        q.voxel[i] = q.voxel[at + i];
    }
    q.count = left;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
