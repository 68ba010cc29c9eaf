// SPDX-License-Identifier: Apache-2.0
// Unbiased transmittance along rays by ratio tracking on the grid of majorants.
// in: rays, one sequence of random numbers each -> out: estimates whose mean is exp(-tau).
// docs/methods.md 2 "Ratio tracking" (Novak et al. 2014), with the one-voxel look-up of trace.h.
#pragma once
#include "kernels_cpu/track_grid.h"
#include "kernels_cpu/walk.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// A piece of a straight line that begins on or in the box.
template <int W>
struct TrackRay {
    Vec<F<W>> p;  // voxels
    Vec<F<W>> d;  // unit
    F<W> metres;  // length; beyond the box counts as empty, infinity is allowed
};

/// Weights below this play Russian roulette: survive as this with probability weight / this.
constexpr float kRatioRoulette = 1.0f / 16.0f;

/// One ray per lane under way.
template <int W>
struct RatioState : Walker<W> {
    F<W> weight, carry;  // the estimate is their sum; carry is what rounding took
    F<W> left;           // metres to go
    U<W> event, begin;   // next draw; the ray's first
    M<W> alive;
};

/// Tentative collisions in the lanes of `m`: keep the share that meets nothing.
template <int W>
PILEUS_FN void ratio_collide(RatioState<W>& s, const TrackGrid& k, Key key, U<W> number, M<W> m,
                             F<W> bound) {
    using T = F<W>;
    // One word places the look-up, the other is the next free flight; that flight's tail, once in
    // 2^24, shares the first.
    const Words<U<W>> w = threefry(key.k0, key.k1, number, s.event);
    s.event = select(m, s.event + 1u, s.event);
    const I<W> voxel = corner_voxel(s.p, w.b, k);
    const T density = gather(k.density, select(m, voxel, I<W>{}));
    // Take off the share that meets something; carry the rounding, for a million collisions in
    // thin air under a dense block's bound would add theirs up.
    const T share = min_(density / bound, all<T>(1.0f));
    const T carry = s.carry - (s.weight + s.carry) * share;
    const T weight = s.weight + carry;
    s.carry = select(m, carry - (weight - s.weight), s.carry);
    s.weight = select(m, weight, s.weight);
    s.tau = select(m, free_flight(w.a, w.b), s.tau);

    // Keep the mean: survive with probability weight / kRatioRoulette, as kRatioRoulette.
    const M<W> low = m & (s.weight < kRatioRoulette);
    if (any(low)) {
        const Words<U<W>> r = threefry(key.k0, key.k1, number, s.event);
        const M<W> drawn = low & (s.weight > 0.0f);
        s.event = select(drawn, s.event + 1u, s.event);
        const M<W> survives = drawn & (uniform(r.a) * kRatioRoulette < s.weight);
        s.weight = select(low, select(survives, all<T>(kRatioRoulette), T{}), s.weight);
        s.carry = select(low, T{}, s.carry);
        s.alive = s.alive & lnot(low & lnot(survives));
    }
    s.alive = s.alive & lnot(m & (s.event - s.begin >= k.max_events));
}

/// Estimates in [0, 1] of the transmittance along `ray` in the lanes of `wanted`, 1 elsewhere.
/// Draw number j of a lane is threefry(key, number, j); `event` is the first free j before and
/// after, so it grows by the draws made and lanes that are not wanted keep theirs. Exactly 1 with
/// one draw where no block on the way holds medium. A lane that needs k.max_events draws or more
/// returns the weight it has then: too large by less than that weight. Densities above their
/// block's bound count as the bound.
template <int W>
PILEUS_FN F<W> ratio_transmittance(const TrackGrid& k, const TrackRay<W>& ray, Key key, U<W> number,
                                   U<W>& event, M<W> wanted) {
    using T = F<W>;
    const T middle = all<T>(0.5f), one = all<T>(1.0f);
    RatioState<W> s{};
    s.p = {middle, middle, middle};
    s.d.z = s.inverse.x = s.inverse.y = s.inverse.z = one;
    // Lanes that are not wanted may hold anything, also what no integer can.
    set_position(s, k, wanted,
                 {select(wanted, ray.p.x, middle), select(wanted, ray.p.y, middle),
                  select(wanted, ray.p.z, middle)});
    set_direction(s, k, wanted, ray.d);
    s.weight = one;
    s.left = ray.metres;
    s.alive = wanted;
    s.begin = event;
    const Words<U<W>> first = threefry(key.k0, key.k1, number, event);
    s.event = select(wanted, event + 1u, event);
    s.tau = free_flight(first.a, first.b);

    while (any(s.alive)) {
        const Stride<W> m = stride(s, k, k.majorant, s.alive);
        // What lies beyond the ray's end is not met any more.
        s.left = s.left - m.metres;
        s.alive = s.alive & (s.left > 0.0f);
        if (any(m.hops)) s.alive = s.alive & lnot(cross(s, k, m).out);
        const M<W> hits = m.hits & s.alive;
        if (any(hits)) ratio_collide(s, k, key, number, hits, m.bound);
    }
    event = s.event;
    return s.weight + s.carry;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
