// SPDX-License-Identifier: Apache-2.0
// Photons through a heterogeneous medium: delta tracking on a grid of majorants.
// in: a range of photons of one light -> out: deposits in collectors and an exact energy ledger.
// docs/methods.md 2 (delta tracking, stochastic look-up) and 3, "Track" and "Store".
// Each lane carries one photon and takes the next when it dies; random numbers belong to
// (photon, event), so neither lanes nor threads can change a result.
#pragma once
#include "kernels_cpu/trace_turn.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Ask for the memory that the lanes of `m` will read, so that it comes while others compute.
template <int W>
PILEUS_FN void fetch_ahead(const float* density, const std::int32_t* collectors, std::uint32_t m,
                           I<W> corner, I<W> voxel, const float* parts) {
    for (; m != 0; m &= m - 1) {
        const int i = lowest_bit(m);
        prefetch_(density + lane(corner, i));
        if (parts != nullptr) prefetch_(parts + lane(corner, i));
        if (collectors != nullptr) prefetch_(collectors + lane(voxel, i));
    }
}

/// Move every living lane to its next collision or block border.
template <int W, int NC>
PILEUS_FN void advance(Group<W, NC>& g, const TraceParams& k, const TraceBuffers& b) {
    Photon<W, NC>& s = g.s;
    g.before = s.alive;
    const M<W> flies = s.alive & (g.waits == 0);
    const Stride<W> m = stride(s, k.grid, k.grid.majorant, flies);
    g.hits = m.hits;
    g.bound = m.bound;
    s.path = s.path + select(flies, m.metres, F<W>{});
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
PILEUS_FN void collide(Group<W, NC>& g, const TraceParams& k, const TraceBuffers& b, int group,
                       Queues<W, NC>& queues) {
    using T = F<W>;
    Photon<W, NC>& s = g.s;
    const Words<U<W>> flight = threefry(k.key.k0, k.key.k1, s.index + k.first_photon, s.event * 4u);
    const T density = gather(k.grid.density, g.corner);
    const auto over = g.hits & (density > g.bound);
    if (any(over)) b.tally->majorant_violations += count_bits(bits_of(over));

    const auto medium = g.hits & (density > 0.0f);
    if (k.mode != kDepositNone && k.mode != kDepositOutgoing && any(medium))
        deposit(k, b, queues.deposits, s, medium, g.voxel, density / g.bound, g.corner, density);
    s.tau = select(g.hits, free_flight(flight.a, g.spare), s.tau);
    const T level = uniform(flight.b) * g.bound;
    const auto real = medium & (level < density);
    if (any(real)) {
        // Below the density the level is uniform still: it falls to each medium by its share.
        const I<W> whose = k.media > 1
                               ? medium_under(b.parts, voxels_of(k.grid), k.media, g.corner, level)
                               : I<W>{};
        scatter(g, k, b, queues.turns, group, real, whose);
    }

    const auto tired = g.hits & s.alive & (s.event >= k.grid.max_events);
    if (any(tired)) {
        PILEUS_FATE(s, *b.tally, terminated, tired);
        s.alive = s.alive & lnot(tired);
    }
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
        const int i = lowest_bit(lanes);
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
    Queues<W, NC> queues{};
    std::uint32_t next = begin;
    for (bool busy = true; busy;) {
        busy = false;
        for (Group<W, NC>& g : groups) {
            busy |= refill(g.s, k, b, next, end);
            advance(g, k, b);
        }
        for (int i = 0; i < kGroups; ++i) {
            Group<W, NC>& g = groups[i];
            if (any(g.hits)) collide(g, k, b, i, queues);
            const auto died = g.before & lnot(g.s.alive);
            if (any(died)) settle(g.s, k, b, died);
        }
        turn_queued(groups, k, b, queues, next >= end);
        flush_deposits(k, b, queues.deposits, busy ? 2 * W - 1 : 0);
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
