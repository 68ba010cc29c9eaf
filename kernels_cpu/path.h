// SPDX-License-Identifier: Apache-2.0
// Path tracing: camera paths through the media, a shadow ray at every turn, all in one loop.
// in: a range of samples -> out: radiance per sample.
// docs/path.md; null-collision tracking and the look-up as in docs/methods.md 2.
// Paths and shadow rays are both walks on one grid, so that lanes of either kind share each step.
#pragma once
#include "kernels_cpu/path_vertex.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Groups of lanes in flight: while one waits for memory the others compute.
constexpr int kPathGroups = 4;

/// Paths, and the tentative collision that each flight has come to.
template <int W, int NC>
struct PathGroup {
    PathLanes<W, NC> s;
    M<W> hits;      // arrived at a tentative collision
    F<W> bound;     // majorant there
    I<W> corner;    // the look-up's voxel
    Words<U<W>> w;  // of the look-up and the next free flight
};

/// Begin the path of launch sample `sample` in lane i, with a ray of the camera.
template <int W, int NC>
PILEUS_FN void begin_paths(PathLanes<W, NC>& s, const PathParams& k, M<W> m, F<W> x, F<W> y) {
    using T = F<W>;
    s.event = select(m, U<W>{}, s.event);
    const Words<U<W>> w = draw(s, k, m), aim = draw(s, k, m);
    if (k.jitter != 0) {
        x = x + (uniform(w.a) - 0.5f);
        y = y + (uniform(w.b) - 0.5f);
    }
    const Ray<T> ray = camera_ray(k.camera, x, y);
    Vec<T> d = ray.direction;
    if (k.camera.flux != 0) {
        const Lambert<T> l = lambert(aim);
        const auto mix = [&](int a) {
            return l.a * k.camera.right[a] + l.b * k.camera.up[a] + l.normal * k.camera.forward[a];
        };
        d = normalized(Vec<T>{mix(0), mix(1), mix(2)});
    }
    s.vertex = {select(m, ray.origin.x, s.vertex.x), select(m, ray.origin.y, s.vertex.y),
                select(m, ray.origin.z, s.vertex.z)};
    s.next = {select(m, d.x, s.next.x), select(m, d.y, s.next.y), select(m, d.z, s.next.z)};
    for (int c = 0; c < NC; ++c) s.beta[c] = select(m, all<T>(1.0f), s.beta[c]);
    for (T& sum : s.sum) sum = select(m, T{}, sum);
    s.order = select(m, I<W>{}, s.order);
    s.bounces = select(m, I<W>{}, s.bounces);
    s.flight = select(m, all<I<W>>(kFlightPath), s.flight);
    s.alive = s.alive | m;
    s.outside = s.outside | m;
    s.cloud = s.cloud & lnot(m);
}

/// Give the lanes of `idle` the next samples; returns those that began.
template <int W, int NC>
PILEUS_FN M<W> refill_paths(PathLanes<W, NC>& s, const PathParams& k, PathTally& tally,
                            std::uint32_t idle, std::uint32_t& next, std::uint32_t end) {
    const U<W> lanes = reinterpret<U<W>>(iota<I<W>>());
    M<W> fresh = s.alive & lnot(s.alive);
    F<W> x{}, y{};
    const std::uint32_t width = std::uint32_t(k.camera.width);
    for (; idle != 0 && next < end; idle &= idle - 1, ++next) {
        const int i = __builtin_ctz(idle);
        const std::uint32_t pixel = k.first_pixel + next / k.per_pixel;
        const std::uint32_t sample = k.first_sample + next % k.per_pixel;
        set_lane(s.number, i, sample * k.pixels + pixel);
        set_lane(s.sample, i, next);
        set_lane(x, i, float(std::int32_t(pixel % width)));
        set_lane(y, i, float(std::int32_t(pixel / width)));
        fresh = fresh | (lanes == std::uint32_t(i));
    }
    if (!any(fresh)) return fresh;
    tally.paths += count_bits(bits_of(fresh));
    begin_paths(s, k, fresh, x, y);
    return fresh;
}

/// Store the radiance of paths that have ended.
template <int W, int NC>
PILEUS_FN void store_paths(const PathLanes<W, NC>& s, const PathParams& k, const PathBuffers& b,
                           std::uint32_t lanes) {
    const float unit = k.camera.flux != 0 ? kPi : 1.0f;
    const int count = k.parts_wanted != 0 ? 3 * kPathParts : 3;
    for (; lanes != 0; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        float* out = b.radiance + lane(s.sample, i);
        bool finite = true;
        for (int c = 0; c < count; ++c) {
            const float v = lane(s.sum[c], i) * unit;
            finite = finite && v - v == 0.0f;
        }
        for (int c = 0; c < count; ++c)
            out[std::uint64_t(c) * b.stride] = finite ? lane(s.sum[c], i) * unit : 0.0f;
        if (!finite) ++b.tally->nan;
    }
}

/// Serve the lanes whose flights have ended, begin new paths, and send them all on.
template <int W, int NC>
PILEUS_FN void serve(PathLanes<W, NC>& s, const PathParams& k, const PathBuffers& b,
                     std::uint32_t& next, std::uint32_t end) {
    constexpr std::uint32_t kFull = (1u << W) - 1u;
    const std::uint32_t before = bits_of(s.alive);
    PathTally& tally = *b.tally;
    M<W> due = s.lit;
    if (any(s.lit)) gather_light(s, k, s.lit);
    if (any(s.met)) {
        const M<W> met = s.met;
        s.met = s.met & lnot(met);
        scatter_path(s, k, tally, met);
        due = due | (met & s.alive);
    }
    if (any(s.out)) due = due | leave_media(s, k, tally, s.out);
    thin_out(s, k, due);
    store_paths(s, k, b, before & ~bits_of(s.alive));
    due = (due & s.alive) | refill_paths(s, k, tally, ~bits_of(s.alive) & kFull, next, end);
    if (any(due)) launch(s, k, tally, due);
}

/// Move every flight to its next tentative collision or block border.
template <int W, int NC>
PILEUS_FN void advance_paths(PathGroup<W, NC>& g, const PathParams& k, const PathBuffers& b) {
    PathLanes<W, NC>& s = g.s;
    const M<W> flying = s.alive & lnot(waiting(s));
    const Stride<W> m = stride(s, k.grid, k.grid.majorant, flying);
    g.hits = m.hits;
    g.bound = m.bound;
    const M<W> path = s.flight == kFlightPath;
    if (any(m.hops)) {
        b.tally->crossings += count_bits(bits_of(m.hops));
        const M<W> out = cross(s, k.grid, m).out;
        s.out = s.out | (out & path);
        s.lit = s.lit | (out & lnot(path));
    }
    if (!any(m.hits)) return;
    b.tally->tentative += count_bits(bits_of(m.hits));
    b.tally->shadow_tentative += count_bits(bits_of(m.hits & lnot(path)));
    // One look-up stands for eight: acceptance and transmittance are linear in density.
    g.w = threefry(k.key.k0, k.key.k1, s.number, s.event);
    g.corner = select(m.hits, corner_voxel(s.p, g.w.b, k.grid), I<W>{});
    for (std::uint32_t lanes = bits_of(m.hits); lanes != 0; lanes &= lanes - 1)
        __builtin_prefetch(k.grid.density + lane(g.corner, __builtin_ctz(lanes)));
}

/// Tentative collisions: paths meet the medium or pass, shadow rays lose a share.
template <int W, int NC>
PILEUS_FN void collide_paths(PathGroup<W, NC>& g, const PathParams& k, const PathBuffers& b) {
    using T = F<W>;
    PathLanes<W, NC>& s = g.s;
    const T density = gather(k.grid.density, g.corner);
    const M<W> over = g.hits & (density > g.bound);
    if (any(over)) b.tally->majorant_violations += count_bits(bits_of(over));
    s.tau = select(g.hits, free_flight(g.w.a, g.w.b), s.tau);
    const Words<U<W>> luck = threefry(k.key.k0, k.key.k1, s.number, s.event + 1u);
    s.event = select(g.hits, s.event + 2u, s.event);
    const M<W> path = s.flight == kFlightPath;

    const M<W> rays = g.hits & lnot(path);
    if (any(rays)) {
        // Carry the rounding: a million collisions in thin air would add theirs up.
        const T share = min_(density / g.bound, all<T>(1.0f));
        const T lost = s.carry - (s.seen + s.carry) * share;
        const T seen = s.seen + lost;
        s.carry = select(rays, lost - (seen - s.seen), s.carry);
        s.seen = select(rays, seen, s.seen);
        const M<W> low = rays & (s.seen < kShadowRoulette);
        const M<W> survives = low & (uniform(luck.a) * kShadowRoulette < s.seen);
        s.seen = select(low, select(survives, all<T>(kShadowRoulette), T{}), s.seen);
        s.carry = select(low, T{}, s.carry);
        s.lit = s.lit | (low & lnot(survives));
    }

    const T level = uniform(luck.a) * g.bound;
    const M<W> real = g.hits & path & (level < density);
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
template <int W, int NC>
PILEUS_FN bool worth_serving(const PathLanes<W, NC>& s) {
    constexpr int kFew = W * 3 / 8 > 1 ? W * 3 / 8 : 1;
    const std::uint32_t flying = bits_of(s.alive & lnot(waiting(s)));
    return W - count_bits(flying) >= kFew;
}

template <int W, int NC>
PILEUS_FN void trace_path_lanes(const PathParams& k, const PathBuffers& b, std::uint32_t begin,
                                std::uint32_t end) {
    PathGroup<W, NC> groups[kPathGroups] = {};
    for (PathGroup<W, NC>& g : groups) {
        g.s.p = {all<F<W>>(0.5f), all<F<W>>(0.5f), all<F<W>>(0.5f)};
        g.s.d.z = g.s.inverse.x = g.s.inverse.y = g.s.inverse.z = all<F<W>>(1.0f);
        g.s.next = g.s.to_map = g.s.d;
    }
    std::uint32_t next = begin;
    for (bool busy = true; busy;) {
        busy = false;
        for (PathGroup<W, NC>& g : groups) {
            if (worth_serving(g.s)) serve(g.s, k, b, next, end);
            busy |= any(g.s.alive);
            advance_paths(g, k, b);
        }
        for (PathGroup<W, NC>& g : groups)
            if (any(g.hits)) collide_paths(g, k, b);
    }
}

template <int W>
PILEUS_FN void trace_paths(const PathParams& k, const PathBuffers& b, std::uint32_t begin,
                           std::uint32_t end) {
    if (k.channels == 1)
        trace_path_lanes<W, 1>(k, b, begin, end);
    else
        trace_path_lanes<W, 3>(k, b, begin, end);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
