// SPDX-License-Identifier: Apache-2.0
// Paths that seek the sun: its disc, and branches towards it where phase functions are peaked.
// in: a vertex, the density of its own turns -> out: weights of the sun's light; branches.
// docs/path.md, "Guide": paths and branches by the balance heuristic (Veach 1997, 9.2).
#pragma once
#include "kernels_cpu/path/path_lanes.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <class T>
PILEUS_FN void put(decltype(T{} < T{}) m, const Vec<T>& from, Vec<T>& to) {
    to = {select(m, from.x, to.x), select(m, from.y, to.y), select(m, from.z, to.z)};
}

/// Density of the guide's directions, 1/sr; 0 outside its cone about the sun.
template <class T>
PILEUS_FN T guide_density(const GuideParams& g, T one_minus_cos) {
    return select(one_minus_cos < g.cone, hg_density(all<T>(g.g), one_minus_cos) * g.unit, T{});
}

/// A point of the sun's disc.
template <int W>
PILEUS_FN Vec<F<W>> point_of_sun(const PathParams& k, const Words<U<W>>& w) {
    using T = F<W>;
    const Vec<T> middle{all<T>(k.to_sun[0]), all<T>(k.to_sun[1]), all<T>(k.to_sun[2])};
    const T turn = uniform(w.a) * k.sun_disc;
    const SinCos<T> phi = sincos_turns(uniform(w.b));
    return turned(middle, 1.0f - turn, sqrt_(turn * (2.0f - turn)), phi.cosine, phi.sine);
}

/// Directions over the front of a flat detector: on the average each second is drawn as a branch
/// is, about the sun or `sun`, a point of its disc. Through a narrow peak most light comes from
/// there, and an even draw would hardly meet it. `own` are even draws; `worth` is their density
/// over that of both.
template <int W>
PILEUS_FN Vec<F<W>> seek_from_detector(const PathParams& k, const Vec<F<W>>& own,
                                       const Vec<F<W>>& sun, const Words<U<W>>& w, F<W>& worth) {
    using T = F<W>;
    const Vec<T> front{all<T>(k.camera.forward[0]), all<T>(k.camera.forward[1]),
                       all<T>(k.camera.forward[2])};
    const Turn<T> turn = hg_sample(all<T>(k.guide.g), uniform_open(w.a) * k.guide.share);
    const SinCos<T> phi = sincos_turns(uniform(w.b));
    const Vec<T> way = turned(sun, 1.0f - turn.one_minus_cos, turn.sine, phi.cosine, phi.sine);
    const M<W> even = (w.a & 1u) == 0u;
    const Vec<T> d{select(even, own.x, way.x), select(even, own.y, way.y),
                   select(even, own.z, way.z)};
    const T density = max_(dot(d, front), T{}) * (4.0f * kInvFourPi);
    const T both = 0.5f * (density + guide_density(k.guide, one_minus_cosine(d, sun)));
    worth = density / max_(both, all<T>(1e-30f));
    return d;
}

/// New paths in the lanes of `m` choose their point of the sun's disc, for all their vertices.
template <int W, int NC, int K>
PILEUS_FN void choose_sun(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m) {
    using T = F<W>;
    Vec<T> sun{all<T>(k.to_sun[0]), all<T>(k.to_sun[1]), all<T>(k.to_sun[2])};
    if (k.sun_disc > 0.0f) sun = point_of_sun<W>(k, draw(s, k, m));
    put(m, sun, s.to_sun);
    s.odds = select(m, T{}, s.odds);
    s.branch = s.branch & lnot(m);
    s.forks = s.forks & lnot(m);
}

/// New vertices in the lanes of `m`, whose next direction the path has drawn. Weighs the ray to the
/// sun against the branches that might have come here, and chooses where a branch leaves.
/// `density(way, lanes)`: of the path's own turns, 1/sr.
template <int W, int NC, int K, class Density>
PILEUS_FN void seek_sun(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m, Density density) {
    using T = F<W>;
    constexpr float kSteps = 0x1p16f;
    if (!minds_sun<K>(k)) return;
    // Part of the disc may have set.
    if (k.ground != 0) s.shade = select(m & lnot(s.to_sun.z > 0.0f), T{}, s.shade);
    if (k.guide.on == 0) return;
    // Known from the place alone: a branch's weight holds the chances of those it did not come by.
    const T chance =
        whole_chance(min_(select(m, s.shade, T{}) * (1.0f / k.guide.worth), all<T>(1.0f)), kSteps);
    s.shade = select(m, s.shade / (1.0f + s.odds), s.shade);

    M<W> forks = m & lnot(s.branch) & (s.order < k.max_depth);
    const Words<U<W>> w = draw(s, k, forks);
    forks = forks & (to_float(reinterpret<I<W>>(spare_bits(w))) < chance * kSteps);
    if (any(forks)) {
        const Turn<T> turn = hg_sample(all<T>(k.guide.g), uniform_open(w.a) * k.guide.share);
        const SinCos<T> phi = sincos_turns(uniform(w.b));
        const Vec<T> way =
            turned(s.to_sun, 1.0f - turn.one_minus_cos, turn.sine, phi.cosine, phi.sine);
        const T ahead = guide_density(k.guide, one_minus_cosine(way, s.to_sun));
        const T own = density(way, forks);
        forks = forks & (ahead > 0.0f) & (own > 0.0f);
        put(forks, way, s.fork);
        s.fork_odds =
            select(forks, s.odds + chance * ahead / max_(own, all<T>(1e-30f)), s.fork_odds);
    }
    s.forks = (s.forks & lnot(m)) | forks;

    const T ahead = guide_density(k.guide, one_minus_cosine(s.next, s.to_sun));
    const M<W> within = m & (ahead > 0.0f);
    T odds{};
    if (any(within)) {
        const T own = density(s.next, within);
        odds = select(within, s.odds + chance * ahead / max_(own, all<T>(1e-30f)), T{});
    }
    s.odds = select(m, odds, s.odds);
}

/// Of the lanes of `m`, which set out for a new vertex, those with a branch fly that first, and
/// branches that have left the cone, or would bring little, end.
template <int W, int NC, int K>
PILEUS_FN void begin_branches(PathLanes<W, NC, K>& s, const PathParams& k, M<W> m) {
    using T = F<W>;
    m = m & s.alive & (s.flight == kFlightPath);
    const M<W> flies = m & s.branch;
    if (any(flies)) {
        const T ahead = guide_density(k.guide, one_minus_cosine(s.next, s.to_sun));
        const T worth = heaviest(s) * ahead / (1.0f + s.odds);
        const T chance = select(flies, worth * (1.0f / k.guide.worth), all<T>(1.0f));
        const M<W> low = flies & (chance < 1.0f);
        const M<W> survives = low & (uniform(draw(s, k, low).a) < chance);
        const T gain = 1.0f / max_(chance, all<T>(1e-30f));
        for (int c = 0; c < NC; ++c) s.beta[c] = select(survives, s.beta[c] * gain, s.beta[c]);
        const M<W> dies = low & lnot(survives), leads_nowhere = flies & lnot(s.odds > 0.0f);
        end_paths(s, dies | leads_nowhere);
    }
    m = m & s.forks;
    if (!any(m)) return;
    put(m, s.vertex, s.main.vertex);
    put(m, s.next, s.main.next);
    for (int c = 0; c < NC; ++c) s.main.beta[c] = select(m, s.beta[c], s.main.beta[c]);
    s.main.odds = select(m, s.odds, s.main.odds);
    s.main.next_density = select(m, s.next_density, s.main.next_density);
    s.main.order = select(m, s.order, s.main.order);
    s.main.outside = (s.main.outside & lnot(m)) | (s.outside & m);
    put(m, s.fork, s.next);
    s.odds = select(m, s.fork_odds, s.odds);
    s.branch = s.branch | m;
    s.forks = s.forks & lnot(m);
}

/// Where a branch has ended in a lane of `lived`, its path goes on; returns these lanes.
template <int W, int NC, int K>
PILEUS_FN M<W> resume_paths(PathLanes<W, NC, K>& s, M<W> lived) {
    const M<W> m = lived & lnot(s.alive) & s.branch;
    if (!any(m)) return m;
    put(m, s.main.vertex, s.vertex);
    put(m, s.main.next, s.next);
    for (int c = 0; c < NC; ++c) s.beta[c] = select(m, s.main.beta[c], s.beta[c]);
    s.odds = select(m, s.main.odds, s.odds);
    s.next_density = select(m, s.main.next_density, s.next_density);
    s.order = select(m, s.main.order, s.order);
    s.outside = (s.outside & lnot(m)) | (s.main.outside & m);
    s.flight = select(m, all<I<W>>(kFlightPath), s.flight);
    s.branch = s.branch & lnot(m);
    s.alive = s.alive | m;
    return m;
}

/// Paths of the lanes of `m` have left the media: branches end there, and others have all of the
/// light that is behind. Returns the lanes that go on.
template <int W, int NC, int K>
PILEUS_FN M<W> leave_branches(PathLanes<W, NC, K>& s, M<W> m) {
    const M<W> branch = m & s.branch;
    end_paths(s, branch);
    s.odds = select(m, F<W>{}, s.odds);
    return m & lnot(branch);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
