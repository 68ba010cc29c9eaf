// SPDX-License-Identifier: Apache-2.0
// Beginnings of paths: rays of the camera, flown in full vectors to the first medium that they
// meet. in: numbers of samples -> out: walkers that stand at medium; light of rays that meet none.
// docs/path.md, "How it runs": a lane that falls free takes one ray over.
#pragma once
#include "kernels_cpu/core/meshes.h"
#include "kernels_cpu/path/path_vertex.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Light at the camera per light along a ray; 1 where K does not ask for it.
template <int W, bool Guided>
struct RayWorth {};
template <int W>
struct RayWorth<W, true> {
    F<W> worth;
};

/// Rays that wait for a lane.
template <int W, int K>
struct FreshPaths : Walls<W, kSolid<K>>, RayWorth<W, kGuided<K>> {
    Flight<W> flight;
    Vec<F<W>> origin;     // metres
    U<W> number, sample;  // as in PathLanes
    M<W> out;             // met nothing, and is to be served
    std::uint32_t ready;  // bit per lane: waits
    std::uint32_t event;  // draws made
};

/// Store the radiance of the samples in `lanes`, `worth` times light[c] for c < `count`.
template <int W>
PILEUS_FN void store_radiance(const F<W>* light, int count, const F<W>& worth, const U<W>& sample,
                              const PathParams& k, const PathBuffers& b, std::uint32_t lanes) {
    const float unit = k.camera.flux != 0 ? kPi : 1.0f;
    for (; lanes != 0; lanes &= lanes - 1) {
        const int i = lowest_bit(lanes);
        const float own = lane(worth, i);
        float* out = b.radiance + lane(sample, i);
        bool finite = true;
        for (int c = 0; c < count; ++c) {
            const float v = lane(light[c], i) * unit * own;
            finite = finite && v - v == 0.0f;
        }
        for (int c = 0; c < count; ++c)
            out[std::uint64_t(c) * b.stride] = finite ? lane(light[c], i) * unit * own : 0.0f;
        if (!finite) ++b.tally->nan;
    }
}

/// Directions over the front of a flat detector.
template <int W>
PILEUS_FN Vec<F<W>> flux_direction(const CameraParams& c, const Words<U<W>>& w) {
    const Lambert<F<W>> l = lambert(w);
    const auto mix = [&](int a) {
        return l.a * c.right[a] + l.b * c.up[a] + l.normal * c.forward[a];
    };
    return normalized(Vec<F<W>>{mix(0), mix(1), mix(2)});
}

/// Whether rays of a flat detector seek the sun, too: where phase functions are peaked, and the
/// detector faces it.
PILEUS_FN bool seeks_from_detector(const PathParams& k) {
    const float *f = k.camera.forward, *s = k.to_sun;
    return k.camera.flux != 0 && k.guide.on != 0 && f[0] * s[0] + f[1] * s[1] + f[2] * s[2] > 0.0f;
}

/// Fly the lanes of `m` through empty blocks; returns those that leave the box.
template <int W>
PILEUS_FN M<W> leap_to_medium(Flight<W>& s, const PathParams& k, PathTally& tally, M<W> m) {
    M<W> out = m & lnot(m);
    for (m = m & (s.bound <= 0.0f); any(m); m = m & (s.bound <= 0.0f)) {
        const Step<W> step = step_flight(s, k.grid, m);
        tally.crossings += count_bits(bits_of(step.hops));
        if (any(step.lost)) tally.terminated += count_bits(bits_of(step.lost));
        out = out | step.out;
        m = m & lnot(step.out);
    }
    return out;
}

/// Place and direction of the camera's rays through the pixels (x, y) of the whole picture of the
/// lanes of `m`.
template <int W, int K>
PILEUS_FN void aim_camera(FreshPaths<W, K>& f, const PathParams& k, M<W> m, F<W> x, F<W> y) {
    // One draw for the place in the pixel, 16 bits each way, and the first free flight.
    const Words<U<W>> w = threefry(k.key.k0, k.key.k1, f.number, U<W>{});
    if (k.jitter != 0) {
        const auto place = [](U<W> bits) {
            return to_float(reinterpret<I<W>>(bits)) * 0x1p-16f + (0x1p-17f - 0.5f);
        };
        x = x + place(w.a & 0xffffu);
        y = y + place(w.b & 0xffffu);
    }
    const U<W> word = (w.a & 0xffff0000u) | (w.b >> 16);
    Words<U<W>> more{};
    const M<W> tail = m & ((word >> 8) == 0u);
    if (any(tail)) more = threefry(k.key.k0, k.key.k1, f.number, U<W>{} + 1u);
    f.flight.tau = free_flight(word, more.b);

    const Ray<F<W>> ray = picture_ray(k.camera, x, y);
    Vec<F<W>> d = ray.direction;
    if (k.camera.flux != 0)
        d = flux_direction<W>(k.camera, threefry(k.key.k0, k.key.k1, f.number, U<W>{} + 2u));
    f.event = 3;
    if constexpr (kGuided<K>) {
        f.worth = all<F<W>>(1.0f);
        if (seeks_from_detector(k)) {
            const Words<U<W>> luck = threefry(k.key.k0, k.key.k1, f.number, U<W>{} + 3u);
            Vec<F<W>> sun{all<F<W>>(k.to_sun[0]), all<F<W>>(k.to_sun[1]), all<F<W>>(k.to_sun[2])};
            // The draw by which the path finds the same point once more.
            if (k.sun_disc > 0.0f)
                sun = point_of_sun<W>(k, threefry(k.key.k0, k.key.k1, f.number, U<W>{} + 4u));
            d = seek_from_detector<W>(k, d, sun, luck, f.worth);
            f.event = 4;
        }
    }
    f.origin = ray.origin;
    aim_flight(f.flight, k.grid, m, d);
}

/// The next samples' pixels, one per lane, as the whole picture counts them; returns the lanes that
/// have one.
template <int W, int K>
PILEUS_FN M<W> next_samples(FreshPaths<W, K>& f, const PathParams& k, std::uint32_t& next,
                            std::uint32_t end, F<W>& x, F<W>& y) {
    const std::uint32_t width = std::uint32_t(k.camera.width);
    int count = 0;
    for (; count < W && next < end; ++count, ++next) {
        const std::uint32_t pixel = k.first_pixel + next / k.per_pixel;
        const std::uint32_t number = k.first_sample + next % k.per_pixel;
        const std::uint32_t column = pixel % width + std::uint32_t(k.camera.left);
        const auto row = std::uint32_t(picture_row(k.camera, std::int32_t(pixel / width)));
        const std::uint32_t own = row * std::uint32_t(whole_width(k.camera)) + column;
        set_lane(f.number, count, number * k.pixels + own);
        set_lane(f.sample, count, next);
        set_lane(x, count, float(std::int32_t(column)));
        set_lane(y, count, float(std::int32_t(row)));
    }
    return iota<I<W>>() < count;
}

/// The camera's rays learn what they will meet: of mesh, image and ground the nearest.
template <int W, int K>
PILEUS_FN void aim_at_solids(FreshPaths<W, K>& f, const PathParams& k, M<W> m) {
    using T = F<W>;
    T limit = way_to_ground<W>(k, f.origin, f.flight.d);
    f.piece = all<I<W>>(kNoWall);
    f.wall = all<T>(__builtin_inff());
    if (k.camera_depth != nullptr) {
        T depth = f.wall;
        for (std::uint32_t lanes = bits_of(m); lanes != 0; lanes &= lanes - 1) {
            const int i = lowest_bit(lanes);
            set_lane(depth, i, k.camera_depth[k.first_pixel + lane(f.sample, i) / k.per_pixel]);
        }
        const M<W> hidden = m & (depth <= limit);
        f.piece = select(hidden, all<I<W>>(kImageWall), f.piece);
        f.wall = select(hidden, depth, f.wall);
        limit = min_(limit, depth);
    }
    if (has_meshes(k.solids)) {
        const SolidHit<T> hit = hit_solids(k.solids, f.origin, f.flight.d, limit, m);
        f.piece = select(hit.triangle >= 0, hit.triangle, f.piece);
        f.wall = select(hit.triangle >= 0, hit.distance, f.wall);
    }
    cut_flights<W>(f.flight, k, m & (f.piece != kNoWall), f.origin, f.wall);
}

/// Rays of the next samples, as many as there are lanes. What sees nothing but sky is done.
template <int W, int K>
PILEUS_FN void fill_fresh(FreshPaths<W, K>& f, const PathParams& k, const PathBuffers& b,
                          std::uint32_t& next, std::uint32_t end) {
    using T = F<W>;
    T x{}, y{};
    const M<W> m = next_samples<W>(f, k, next, end, x, y);
    b.tally->paths += count_bits(bits_of(m));
    aim_camera<W>(f, k, m, x, y);
    const M<W> missed = send_flights<W>(f.flight, k, m, f.origin, m);
    if constexpr (kLamps<K>) f.flight.t = select(missed, T{}, f.flight.t);
    if constexpr (kSolid<K>) aim_at_solids(f, k, m);
    f.out = missed | leap_to_medium(f.flight, k, *b.tally, m & lnot(missed));
    M<W> sky = f.out;
    if constexpr (kSolid<K>) sky = sky & (f.piece == kNoWall);
    if (k.ground != 0) sky = sky & lnot((f.flight.d.z < 0.0f) & (f.origin.z - k.ground_z >= 0.0f));
    f.ready = bits_of(m & lnot(sky));
    if (!any(sky)) return;
    const Vec<T> light = sky_light<W>(k, f.flight.d);
    T worth = all<T>(1.0f);
    if constexpr (kGuided<K>) worth = f.worth;
    const T sum[3 * kPathParts] = {light.x, light.y, light.z};
    store_radiance<W>(sum, k.parts_wanted != 0 ? 3 * kPathParts : 3, worth, f.sample, k, b,
                      bits_of(sky));
}

/// Hand the waiting ray `from` over to lane `to`.
template <class Lanes, int W, int K>
PILEUS_FN void hand_over(Lanes& s, int to, const FreshPaths<W, K>& f, int from) {
    const auto move = [&](auto& a, const auto& b) { set_lane(a, to, lane(b, from)); };
    const auto move3 = [&](auto& a, const auto& b) {
        move(a.x, b.x), move(a.y, b.y), move(a.z, b.z);
    };
    const Flight<W>& w = f.flight;
    move3(s.from, w.from), move3(s.speed, w.speed), move3(s.d, w.d);
    move3(s.plane, w.plane), move3(s.gap, w.gap), move3(s.vertex, f.origin);
    move(s.t, w.t), move(s.exit, w.exit), move(s.cut, w.cut), move(s.tau, w.tau);
    move(s.bound, w.bound), move(s.lift, w.lift), move(s.block, w.block);
    move(s.wraps, w.wraps);
    move(s.number, f.number), move(s.sample, f.sample);
    if constexpr (kGuided<K>) move(s.worth, f.worth);
    if constexpr (kSolid<K>) move(s.wall, f.wall), move(s.piece, f.piece);
}

/// Lanes that have been given the next samples.
template <int W>
struct Refilled {
    M<W> fresh, out;  ///< all of them; and those whose rays met nothing
};
/// Hand the rays of the next samples over to the lanes of `idle`; they fly already.
template <int W, class Lanes, int K>
PILEUS_FN Refilled<W> hand_over_next(Lanes& s, FreshPaths<W, K>& f, const PathParams& k,
                                     const PathBuffers& b, std::uint32_t idle, std::uint32_t& next,
                                     std::uint32_t end) {
    const I<W> lanes = iota<I<W>>();
    M<W> fresh = s.alive & lnot(s.alive), out = fresh;
    while (idle != 0) {
        if (f.ready == 0) {
            if (next >= end) break;
            fill_fresh<W>(f, k, b, next, end);
            continue;
        }
        const int to = lowest_bit(idle), from = lowest_bit(f.ready);
        hand_over(s, to, f, from);
        const M<W> here = lanes == to;
        fresh = fresh | here;
        if ((bits_of(f.out) >> from) & 1u) out = out | here;
        idle &= idle - 1, f.ready &= f.ready - 1;
    }
    return {fresh, out};
}

/// Give the lanes of `idle` the next samples.
template <int W, int NC, int K>
PILEUS_FN void refill_paths(PathLanes<W, NC, K>& s, FreshPaths<W, K>& f, const PathParams& k,
                            const PathBuffers& b, std::uint32_t idle, std::uint32_t& next,
                            std::uint32_t end) {
    const Refilled<W> given = hand_over_next(s, f, k, b, idle, next, end);
    const M<W>& fresh = given.fresh;
    if (!any(fresh)) return;
    s.event = select(fresh, U<W>{} + f.event, s.event);
    if constexpr (kGuided<K>) choose_sun(s, k, fresh);
    for (int c = 0; c < NC; ++c) s.beta[c] = select(fresh, all<F<W>>(1.0f), s.beta[c]);
    for (F<W>& sum : s.sum) sum = select(fresh, F<W>{}, sum);
    s.order = select(fresh, I<W>{}, s.order);
    s.bounces = select(fresh, I<W>{}, s.bounces);
    s.flight = select(fresh, all<I<W>>(kFlightPath), s.flight);
    s.alive = s.alive | fresh;
    s.outside = s.outside | fresh;
    s.cloud = s.cloud & lnot(fresh);
    if constexpr (kLamps<K>) s.near_done = s.near_done & lnot(fresh);
    s.out = s.out | given.out;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
