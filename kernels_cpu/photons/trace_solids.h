// SPDX-License-Identifier: Apache-2.0
// Photons among solids: what lies ahead of a flight, what happens there.
// in: photons under way -> out: walls found, photons absorbed or reflected, the ledger's fate
// solid. docs/solids.md, "Shadows in clouds". Solids outside of the box only hide its lights and
// its ground.
#pragma once
#include "kernels_cpu/photons/trace_turn.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Where the lanes stand, metres.
template <int W, int NC, bool S>
PILEUS_FN Vec<F<W>> photon_metres(const Photon<W, NC, S>& s, const TraceParams& k) {
    return {s.p.x * k.grid.cell[0], s.p.y * k.grid.cell[1], s.p.z * k.grid.cell[2]};
}

/// Find what lies ahead of the lanes of `m` that do not know it.
template <int W, int NC, bool S>
PILEUS_FN void look_ahead(Photon<W, NC, S>& s, const TraceParams& k, M<W> m) {
    const M<W> blind = m & (s.wall < 0.0f);
    if (!any(blind)) return;
    const SolidHit<F<W>> hit =
        hit_solids(k.solids, photon_metres(s, k), s.d, all<F<W>>(3e38f), blind);
    s.wall = select(blind, hit.distance, s.wall);
    s.piece = select(blind, hit.triangle, s.piece);
}

/// Fresh photons of `m` whose way to the box is blocked end at the solid that blocks it.
template <int W, int NC, bool S>
PILEUS_FN void hide_fresh(Photon<W, NC, S>& s, const TraceParams& k, TraceTally& tally, M<W> m) {
    const Vec<F<W>> back{F<W>{} - s.d.x, F<W>{} - s.d.y, F<W>{} - s.d.z};
    // What comes up from the ground is hidden by what lies on it as well.
    const M<W> hidden = behind_solids(k.solids, photon_metres(s, k), back, all<F<W>>(3e38f), m);
    if (!any(hidden)) return;
    PILEUS_FATE(s, tally, solid, hidden);
    s.alive = s.alive & lnot(hidden);
}

/// What a solid of these colours keeps of a photon that it sends back, in whole quanta.
template <int W, int NC, bool S>
PILEUS_FN void tint(Photon<W, NC, S>& s, TraceTally& tally, M<W> m, const SolidPlace<F<W>>& place,
                    F<W> most) {
    for (std::uint32_t lanes = bits_of(m); lanes != 0; lanes &= lanes - 1) {
        const int i = lowest_bit(lanes);
        const bool dark = (bits_of(s.shadow) >> i) & 1u;
        Fates& fates = dark ? tally.shadow : tally.light;
        for (int c = 0; c < NC; ++c) {
            const float before = lane(s.weight[c], i);
            const float after = before * (lane(place.albedo[c], i) / lane(most, i));
            fates.solid[c] += quantise(before, 0x1p20f) - quantise(after, 0x1p20f);
            set_lane(s.weight[c], i, after);
        }
    }
}

/// Photons that stand at a solid: roulette by its brightest channel, then a Lambertian turn.
template <int W, int NC, bool S>
PILEUS_FN void meet_solid(Photon<W, NC, S>& s, const TraceParams& k, TraceTally& tally) {
    using T = F<W>;
    const M<W> m = s.stopped;
    const M<W> tired = m & (s.event >= k.grid.max_events);
    if (any(tired)) PILEUS_FATE(s, tally, terminated, tired);
    tally.bounces += count_bits(bits_of(m));
    s.event = select(m, s.event + 1u, s.event);
    s.order = select(m, s.order + 1, s.order);
    s.strayed = select(m, all<I<W>>(1), s.strayed);
    // Flat: photons bring what meets the triangle itself, and the ledger counts it.
    const SolidPlace<T> place = place_on_solid<false>(
        k.solids, photon_metres(s, k), s.d, SolidHit<T>{T{}, select(m, s.piece, s.piece | -1)});
    const T most = max_(max_(place.albedo[0], place.albedo[1]), place.albedo[2]);
    const U<W> number = s.index + k.first_photon, at = s.event * 4u;
    const Words<U<W>> first = threefry(k.key.k0, k.key.k1, number, at + 2u);
    const Lambert<T> up = lambert(threefry(k.key.k0, k.key.k1, number, at + 3u));
    const M<W> spared = uniform(first.a) < most;
    const M<W> kept = m & lnot(tired) & spared;
    const M<W> lost = m & lnot(tired | kept);
    if (any(lost)) PILEUS_FATE(s, tally, solid, lost);
    s.alive = s.alive & lnot(lost | tired);
    if (!any(kept)) return;
    if constexpr (NC > 1) tint(s, tally, kept, place, most);
    const Vec<T> d = turned(place.normal, max_(up.normal, all<T>(1e-6f)), all<T>(1.0f), up.a, up.b);
    set_direction(s, k.grid, kept, d);
    const auto inside = [&](T metres, int a) {
        return min_(max_(metres * (1.0f / k.grid.cell[a]), T{}), all<T>(float(k.grid.size[a])));
    };
    set_position(s, k.grid, kept,
                 {inside(place.at.x, 0), inside(place.at.y, 1), inside(place.at.z, 2)});
    s.enters = select(kept, all<I<W>>(-1), s.enters);
    s.wall = select(kept, all<T>(-1.0f), s.wall);
    s.tau = select(kept, free_flight(first.b, first.a), s.tau);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
