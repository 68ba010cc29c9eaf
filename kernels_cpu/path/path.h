// SPDX-License-Identifier: Apache-2.0
// Path tracing: camera paths through the media, a shadow ray at every turn, all in one loop.
// in: a range of samples -> out: radiance per sample.
// docs/path.md; null-collision tracking and the look-up as in docs/methods.md 2.
// Paths and shadow rays are both walks on one grid, so that lanes of either kind share each step.
#pragma once
#include "kernels_cpu/path/path_start.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Groups of lanes in flight: while one waits for memory the others compute.
constexpr int kPathGroups = 4;

/// Paths, and the tentative collision that each flight has come to.
template <int W, int NC, int K>
struct PathGroup {
    PathLanes<W, NC, K> s;
    M<W> hits;      // arrived at a tentative collision
    I<W> corner;    // the look-up's voxel
    Words<U<W>> w;  // of the look-up and the next free flight
};

/// Store the radiance of paths that have ended.
template <int W, int NC, int K>
PILEUS_FN void store_paths(const PathLanes<W, NC, K>& s, const PathParams& k, const PathBuffers& b,
                           std::uint32_t lanes) {
    F<W> worth = all<F<W>>(1.0f);
    if constexpr (kGuided<K>) worth = s.worth;
    store_radiance<W>(s.sum, k.parts_wanted != 0 ? 3 * kPathParts : 3, worth, s.sample, k, b,
                      lanes);
}

/// Serve the lanes whose flights have ended, begin new paths, and send them all on.
template <int W, int NC, int K>
PILEUS_FN void serve(PathLanes<W, NC, K>& s, FreshPaths<W, K>& fresh, const PathParams& k,
                     const PathBuffers& b, std::uint32_t& next, std::uint32_t end) {
    constexpr std::uint32_t kFull = (1u << W) - 1u;
    const M<W> lived = s.alive;
    const std::uint32_t before = bits_of(lived);
    PathTally& tally = *b.tally;
    M<W> due = s.alive & lnot(s.alive);
    if constexpr (kLamps<K>) {
        if (minds_lamps<K>(k)) {
            due = gather_lamps(s, k);
            due = due | begin_near(s, k);
        }
    }
    due = due | s.lit;
    if (any(s.lit)) gather_light(s, k, s.lit);
    if (any(s.met)) {
        const M<W> met = s.met;
        s.met = s.met & lnot(met);
        scatter_path(s, k, tally, met);
        due = due | (met & s.alive);
    }
    if (any(s.out)) due = due | leave_media(s, k, tally, s.out);
    if constexpr (kGuided<K>) begin_branches(s, k, due);
    thin_out(s, k, due);
    if constexpr (kGuided<K>) {
        const M<W> back = resume_paths(s, lived);
        thin_out(s, k, back);
        due = due | back;
    }
    due = due & s.alive;
    if (any(due)) launch(s, k, tally, due);
    store_paths(s, k, b, before & ~bits_of(s.alive));
    refill_paths(s, fresh, k, b, ~bits_of(s.alive) & kFull, next, end);
}

/// Borders that a flight may cross before all that have come to a collision are looked after.
constexpr int kHopsPerTurn = 2;

/// Move every flight to its next tentative collision, or some borders on towards it.
template <int W, class Group>
PILEUS_FN void advance_paths(Group& g, const PathParams& k, const PathBuffers& b) {
    auto& s = g.s;
    const M<W> path = s.flight == kFlightPath;
    M<W> flying = s.alive & lnot(waiting(s));
    g.hits = flying & lnot(flying);
    for (int hop = 0; hop < kHopsPerTurn && any(flying); ++hop) {
        const Step<W> m = step_flight(s, k.grid, flying);
        g.hits = g.hits | m.hits;
        b.tally->crossings += count_bits(bits_of(m.hops));
        if (any(m.lost)) b.tally->terminated += count_bits(bits_of(m.lost));
        s.out = s.out | (m.out & path);
        s.lit = s.lit | (m.out & lnot(path));
        flying = m.hops & lnot(m.out);
    }
    if (!any(g.hits)) return;
    b.tally->tentative += count_bits(bits_of(g.hits));
    b.tally->shadow_tentative += count_bits(bits_of(g.hits & lnot(path)));
    // One look-up stands for eight: acceptance and transmittance are linear in density.
    g.w = threefry(k.key.k0, k.key.k1, s.number, s.event);
    const Vec<F<W>> p = place_of(s);
    s.p = {select(g.hits, p.x, s.p.x), select(g.hits, p.y, s.p.y), select(g.hits, p.z, s.p.z)};
    g.corner = select(g.hits, corner_voxel(s.p, g.w.b, k.grid), I<W>{});
    for (std::uint32_t lanes = bits_of(g.hits); lanes != 0; lanes &= lanes - 1)
        prefetch_(k.grid.density + lane(g.corner, lowest_bit(lanes)));
}

/// Shadow rays of the lanes of `rays` lose the share `density` / bound of their light, and end by
/// luck once little is left; `luck` is 0, 1/256 ... 255/256.
template <int W, class Lanes>
PILEUS_FN void dim_rays(Lanes& s, M<W> rays, F<W> density, F<W> luck) {
    using T = F<W>;
    // Carry the rounding: a million collisions in thin air would add theirs up.
    const T share = min_(density / s.bound, all<T>(1.0f));
    const T lost = s.carry - (s.seen + s.carry) * share;
    const T seen = s.seen + lost;
    s.carry = select(rays, lost - (seen - s.seen), s.carry);
    s.seen = select(rays, seen, s.seen);
    const M<W> low = rays & (s.seen < kShadowRoulette);
    if (!any(low)) return;
    const T chance = whole_chance(s.seen * (1.0f / kShadowRoulette), 256.0f);
    const M<W> survives = low & (s.seen > 0.0f) & (luck < chance);
    s.seen = select(low, select(survives, s.seen / chance, T{}), s.seen);
    s.carry = select(low, T{}, s.carry);
    s.lit = s.lit | (low & lnot(survives));
}

/// Tentative collisions: paths meet the medium or pass, shadow rays lose a share. The draw's first
/// word is the next free flight but for eight bits, which decide what happens here; where they do
/// not, and once in 2^24 flights, the next draw has more.
template <int W, int NC, int K>
PILEUS_FN void collide_paths(PathGroup<W, NC, K>& g, const PathParams& k, const PathBuffers& b) {
    using T = F<W>;
    PathLanes<W, NC, K>& s = g.s;
    const T density = gather(k.grid.density, g.corner);
    const M<W> over = g.hits & (density > s.bound);
    if (any(over)) b.tally->majorant_violations += count_bits(bits_of(over));
    const M<W> path = g.hits & (s.flight == kFlightPath), rays = g.hits & lnot(path);
    const T luck = to_float(reinterpret<I<W>>(g.w.a & 0xffu)) * 0x1p-8f;
    T level = luck * s.bound;
    M<W> open = path & (level < density);
    if (k.media <= 1) open = open & ((luck + 0x1p-8f) * s.bound > density);
    const M<W> tail = g.hits & ((g.w.a >> 8) == 0u);
    Words<U<W>> more{};
    if (any(open | tail)) {
        more = threefry(k.key.k0, k.key.k1, s.number, s.event + 1u);
        level = select(open, (luck + uniform(more.a) * 0x1p-8f) * s.bound, level);
    }
    s.tau = select(g.hits, free_flight((g.w.a & 0xffffff00u) | (more.b & 0xffu), more.b), s.tau);
    s.event = select(g.hits, s.event + 2u, s.event);
    if (any(rays)) dim_rays<W>(s, rays, density, luck);
    if constexpr (kLamps<K>) {
        if (k.emits != 0) gather_emission(s, k, path, g.corner, density);
    }

    const M<W> real = path & (level < density);
    if (k.media > 1 && any(real)) {
        // Below the density the level is uniform still: it falls to each medium by its share.
        const std::int64_t voxels = std::int64_t(k.grid.size[0]) * k.grid.size[1] * k.grid.size[2];
        s.medium = select(real, medium_under(k.parts, voxels, k.media, g.corner, level), s.medium);
    }
    s.met = s.met | real;

    const M<W> tired = g.hits & (s.event >= k.grid.max_events);
    if (any(tired)) {
        b.tally->terminated += count_bits(bits_of(tired));
        end_paths(s, tired);
        store_paths(s, k, b, bits_of(tired));
    }
}

/// Whether to serve the lanes now: results belong to samples, so the moment is free.
template <int W, int NC, int K>
PILEUS_FN bool worth_serving(const PathLanes<W, NC, K>& s) {
    constexpr int kFew = W / 2 > 1 ? W / 2 : 1;
    const std::uint32_t flying = bits_of(s.alive & lnot(waiting(s)));
    return W - count_bits(flying) >= kFew;
}

template <int W, int NC, int K>
PILEUS_FN void trace_path_lanes(const PathParams& k, const PathBuffers& b, std::uint32_t begin,
                                std::uint32_t end) {
    // Lanes without a path stand at rest in the box: they are carried along by all that follows.
    const auto rest = [&](Flight<W>& f) {
        const F<W> middle = all<F<W>>(0.5f);
        f.d.z = all<F<W>>(1.0f);
        begin_flight(f, k.grid, iota<I<W>>() >= 0, {middle, middle, middle});
    };
    FreshPaths<W, K> fresh{};
    rest(fresh.flight);
    PathGroup<W, NC, K> groups[kPathGroups] = {};
    for (PathGroup<W, NC, K>& g : groups) {
        rest(g.s);
        g.s.next = g.s.to_map = g.s.d;
        if constexpr (kLamps<K>) g.s.to_lamp = g.s.kept_d = g.s.d;
        if constexpr (kGuided<K>) g.s.to_sun = g.s.fork = g.s.main.next = g.s.d;
    }
    std::uint32_t next = begin;
    for (bool busy = true; busy;) {
        busy = false;
        for (PathGroup<W, NC, K>& g : groups) {
            if (worth_serving(g.s)) serve(g.s, fresh, k, b, next, end);
            busy |= any(g.s.alive);
            advance_paths<W>(g, k, b);
        }
        for (PathGroup<W, NC, K>& g : groups)
            if (any(g.hits)) collide_paths(g, k, b);
    }
}

/// Paths of every scene. Grey media have the same numbers in all of their channels.
template <int W>
PILEUS_FN void trace_paths_full(const PathParams& k, const PathBuffers& b, std::uint32_t begin,
                                std::uint32_t end) {
    constexpr int kAll = kAmongSolids | kSeekingSun | (kLights ? kLitByLamps : 0);
    trace_path_lanes<W, 3, kAll>(k, b, begin, end);
}

/// Those of scenes with no more than media, sun, sky and ground: needs_full() is false.
template <int W>
PILEUS_FN void trace_paths(const PathParams& k, const PathBuffers& b, std::uint32_t begin,
                           std::uint32_t end) {
#ifdef PILEUS_ONE_PATH_KERNEL
    trace_paths_full<W>(k, b, begin, end);
#else
    if (k.channels == 1)
        trace_path_lanes<W, 1, 0>(k, b, begin, end);
    else
        trace_path_lanes<W, 3, 0>(k, b, begin, end);
#endif
}

}  // namespace PILEUS_ISA
}  // namespace pileus
