// SPDX-License-Identifier: Apache-2.0
// Photons through a heterogeneous medium: delta tracking on a grid of majorants.
// in: a range of photons of one light -> out: deposits in collectors and an exact energy ledger.
// docs/methods.md 2 (delta tracking, stochastic look-up) and 3, "Track" and "Store".
// Each lane carries one photon and takes the next when it dies; random numbers belong to
// (photon, event), so neither lanes nor threads can change a result.
#pragma once
#include "kernels_cpu/core/meshes.h"
#include "kernels_cpu/photons/meters.h"
#include "kernels_cpu/photons/trace_solids.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Ask for the memory that the lanes will read, so that it comes while others compute. All lanes:
/// a loop over some would end where no processor expects it.
template <int W, class S>
PILEUS_FN void fetch_ahead(const S* grid, I<W> at) {
    for (int i = 0; i < W; ++i) prefetch_(grid + lane(at, i));
}

/// Move every living lane to its next collision or block border. `Cells`: a regular grid gathers.
template <bool Cells = false, int W, int NC, bool S>
PILEUS_FN void advance(Group<W, NC, S>& g, const TraceParams& k, const TraceBuffers& b) {
    Photon<W, NC, S>& s = g.s;
    const M<W> flies = s.alive & lnot(g.out) & (g.waits == 0);
    if constexpr (S) look_ahead(s, k, flies);
    g.hits = fly(s, k.grid, flies);
    auto hops = flies & lnot(g.hits);
    if constexpr (S) hops = hops & lnot(s.stopped);
    if (any(hops)) {
        b.tally->crossings += count_bits(bits_of(hops));
        const Crossing<W> c = hop(s, k.grid, hops);
        g.out = g.out | c.out;
        g.by_z = (g.by_z & lnot(c.out)) | (c.by_z & c.out);
    }
    if constexpr (S) {
        if (any(s.stopped)) meet_solid(s, k, *b.tally);
    }
    if (!any(g.hits)) return;
    b.tally->tentative += count_bits(bits_of(g.hits));
    s.event = select(g.hits, s.event + 1u, s.event);
    const Words<U<W>> w = draw(s, k, 1u);
    // One look-up stands for eight: acceptance is linear in density.
    g.corner = select(g.hits, corner_voxel(s.p, w.a, k.grid), I<W>{});
    g.draw = w.b;
    fetch_ahead<W>(k.grid.density, g.corner);
    if constexpr (Cells) {
        g.voxel = select(g.hits, cell_of(s.p, k), I<W>{});
    } else if (k.mode == kDepositIncident || k.mode == kDepositCamera || is_metered(k)) {
        g.voxel = select(g.hits, voxel_of(s.p, k.grid), I<W>{});
        fetch_ahead<W>(b.collector, g.voxel);
    }
    if (k.media > 1) fetch_ahead<W>(b.parts, g.corner);
}

/// Tentative collisions in the lanes that have come to one.
template <bool Cells = false, int W, int NC, bool S>
PILEUS_FN void collide(Group<W, NC, S>& g, const TraceParams& k, const TraceBuffers& b, int group,
                       Queues<W, NC, S>& queues) {
    using T = F<W>;
    Photon<W, NC, S>& s = g.s;
    const T density = gather(k.grid.density, g.corner);
    const auto over = g.hits & (density > s.bound);
    if (any(over)) b.tally->majorant_violations += count_bits(bits_of(over));

    const auto medium = g.hits & (density > 0.0f);
    const T share = density / s.bound;
    if constexpr (Cells)
        deposit_in_cell(k, b, queues.deposits, s, g.hits, g.voxel);
    else if (k.mode != kDepositNone && k.mode != kDepositOutgoing && any(medium))
        deposit(k, b, queues.deposits, s, medium, g.voxel, share, g.corner, density);

    // Of the draw that refuses a collision the part above the share of real ones is even still.
    const T level = uniform(g.draw);
    const auto real = medium & (level < share);
    const auto refused = g.hits & lnot(real);
    s.tau = select(refused, next_flight(g.draw, share, refused, [&] { return draw(s, k, 2u).a; }),
                   s.tau);
    if (any(real)) {
        // Below the share the level is even too: it falls to each medium by its part.
        const I<W> whose = k.media > 1 ? medium_under(b.parts, voxels_of(k.grid), k.media, g.corner,
                                                      level * s.bound)
                                       : I<W>{};
        scatter(g, k, b, queues.turns, group, real, whose);
    }

    const auto tired = g.hits & s.alive & (s.event >= k.grid.max_events);
    if (any(tired)) {
        PILEUS_FATE(s, *b.tally, terminated, tired);
        s.alive = s.alive & lnot(tired);
    }
}

/// Lanes that have left the box do so: tally them, or send them on from the ground.
template <int W, int NC, bool S>
PILEUS_FN void leave(Group<W, NC, S>& g, const TraceParams& k, const TraceBuffers& b) {
    if (any(g.out)) leave_box(g.s, k, b, g.out, g.by_z);
    g.out = g.out & lnot(g.out);
}

/// The next photons in the lanes of `idle`, as long as there are any.
template <int W, int NC, bool S>
PILEUS_FN void refill(Group<W, NC, S>& g, const TraceParams& k, const TraceBuffers& b,
                      std::uint32_t idle, std::uint32_t& next, std::uint32_t end) {
    const U<W> numbers = reinterpret<U<W>>(iota<I<W>>());
    auto fresh = g.holds & lnot(g.holds);
    for (std::uint32_t lanes = idle; lanes != 0 && next < end; lanes &= lanes - 1) {
        const int i = lowest_bit(lanes);
        set_lane(g.s.index, i, next++);
        fresh = fresh | (numbers == std::uint32_t(i));
    }
    const M<W> missed = start_photons(g.s, k, fresh);
    b.tally->photons += count_bits(bits_of(fresh));
    PILEUS_FATE(g.s, *b.tally, emitted, fresh);
    if constexpr (S) hide_fresh(g.s, k, *b.tally, fresh);
    if (any(missed)) miss_box(g.s, k, *b.tally, missed);
    g.holds = g.holds | fresh;
}

/// Books photons that have ended and starts others in their lanes, once a quarter stands idle:
/// results belong to photons, so the moment is free. Returns whether any lane has a photon.
template <int W, int NC, bool S>
PILEUS_FN bool renew(Group<W, NC, S>& g, const TraceParams& k, const TraceBuffers& b,
                     std::uint32_t& next, std::uint32_t end) {
    constexpr std::uint32_t kFull = (1u << W) - 1u;
    const std::uint32_t open = bits_of(g.holds);
    const std::uint32_t ended = bits_of(g.out | (g.holds & lnot(g.s.alive)));
    const std::uint32_t idle = ended | (next < end ? ~open & kFull : 0u);
    if (idle == 0 || ((open & ~ended) != 0 && count_bits(idle) * 4 < W)) return open != 0;
    if (ended != 0) {
        leave(g, k, b);
        settle(g.s, k, b, g.holds & lnot(g.s.alive));
        g.holds = g.s.alive;
    }
    if (next < end) refill(g, k, b, ~bits_of(g.holds) & kFull, next, end);
    return any(g.holds);
}

/// Trace photons [begin, end) of the launch, several groups of lanes in turn: while the memory of
/// one is on its way the others compute.
template <int W, int NC, bool S, bool Cells>
PILEUS_FN void trace_photons(const TraceParams& k, const TraceBuffers& b, std::uint32_t begin,
                             std::uint32_t end) {
    Group<W, NC, S> groups[kGroups] = {};
    for (Group<W, NC, S>& g : groups) {
        g.s.p = {all<F<W>>(0.5f), all<F<W>>(0.5f), all<F<W>>(0.5f)};
        g.s.d.z = g.s.inverse.x = g.s.inverse.y = g.s.inverse.z = all<F<W>>(1.0f);
    }
    Queues<W, NC, S> queues{};
    std::uint32_t next = begin;
    for (bool busy = true; busy;) {
        busy = false;
        for (Group<W, NC, S>& g : groups) {
            busy |= renew(g, k, b, next, end);
            advance<Cells>(g, k, b);
        }
        for (int i = 0; i < kGroups; ++i) {
            if (any(groups[i].hits)) collide<Cells>(groups[i], k, b, i, queues);
        }
        turn_queued(groups, k, b, queues, next >= end);
        flush_deposits<Cells>(k, b, queues.deposits, !busy);
    }
}
#undef PILEUS_FATE

template <int W, bool S = false, bool Cells = false>
PILEUS_FN void trace(const TraceParams& k, const TraceBuffers& b, std::uint32_t begin,
                     std::uint32_t end) {
    if (k.channels == 1)
        trace_photons<W, 1, S, Cells>(k, b, begin, end);
    else
        trace_photons<W, 3, S, Cells>(k, b, begin, end);
}

template <int W>
PILEUS_FN void trace_solids(const TraceParams& k, const TraceBuffers& b, std::uint32_t begin,
                            std::uint32_t end) {
    trace<W, true>(k, b, begin, end);
}

/// A regular grid gathers, with and without solids.
template <int W>
PILEUS_FN void trace_cells(const TraceParams& k, const TraceBuffers& b, std::uint32_t begin,
                           std::uint32_t end) {
    if (has_meshes(k.solids))
        trace<W, true, true>(k, b, begin, end);
    else
        trace<W, false, true>(k, b, begin, end);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
