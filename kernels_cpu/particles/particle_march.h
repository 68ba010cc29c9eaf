// SPDX-License-Identifier: Apache-2.0
// A picture of lit particles: what each ray meets is gathered into bins along it, and these are
// composited front to back. Nothing is sorted.
// in: a tree, depth towards the sun and skylight in every ball -> out: planes of pixels.
// docs/particles.md, "Display": the optical depth of a bin is exact, that towards the sun a mean.
#pragma once
#include "kernels_cpu/core/meshes.h"
#include "kernels_cpu/core/pixel_block.h"
#include "kernels_cpu/display/pixel_light.h"
#include "kernels_cpu/particles/particle_walk.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Least of the lanes that `m` names; some is named.
template <class Int, class Mask>
PILEUS_FN std::int32_t least_lane(Int v, Mask m) {
    std::int32_t least = 0x7fffffff;
    for (std::uint32_t lanes = bits_of(m); lanes != 0; lanes &= lanes - 1) {
        const std::int32_t own = lane(v, lowest_bit(lanes));
        if (own < least) least = own;
    }
    return least;
}
template <class Int, class Mask>
PILEUS_FN std::int32_t largest_lane(Int v, Mask m) {
    return -least_lane(Int{} - v, m);
}

/// Phase functions of the sun's orders along a ray.
template <class T>
struct ParticlePhases {
    T order[kMaxParticleOrders];
};
template <class T>
PILEUS_FN ParticlePhases<T> particle_phases(const ParticleMarchParams& k, const Vec<T>& direction) {
    ParticlePhases<T> p{};
    if (k.orders == 0) return p;
    const Vec<T> sun{all<T>(k.sun_travel[0]), all<T>(k.sun_travel[1]), all<T>(k.sun_travel[2])};
    const T turn =
        one_minus_cosine(sun, Vec<T>{T{} - direction.x, T{} - direction.y, T{} - direction.z});
    const T most = most_density(k.camera, direction);
    p.order[0] = min_(phase_density(k.phase, turn), most);
    for (int n = 1; n < k.orders; ++n)
        p.order[n] = min_(hg_density(all<T>(k.order_g[n]), turn), most);
    return p;
}

/// Optical depth towards the sun from places along rays; `wanted` lanes alone.
template <class T>
PILEUS_FN T shade_at(const ParticleMarchParams& k, const ParticleRay<T>& r, T at, M_of<T> wanted) {
    const Vec<T> place{r.origin.x + at * r.direction.x, r.origin.y + at * r.direction.y,
                       r.origin.z + at * r.direction.z};
    const Vec<T> to_sun{all<T>(-k.sun_travel[0]), all<T>(-k.sun_travel[1]),
                        all<T>(-k.sun_travel[2])};
    const ParticleRay<T> ray = particle_ray(place, to_sun, T{}, all<T>(3e38f));
    return particle_depth(k.view, ray, wanted, k.most);
}

/// How bins find the sun's light: from their balls' depths, or by a walk of their own; of all
/// balls, or by the share that solids leave of it. Of tinted balls they keep the mean colour.
enum class ParticleLit { kShade, kExact, kSeen, kSeenExact, kTinted, kTintedExact };
template <ParticleLit Kind>
constexpr bool kWalks = Kind == ParticleLit::kExact || Kind == ParticleLit::kSeenExact ||
                        Kind == ParticleLit::kTintedExact;
template <ParticleLit Kind>
constexpr bool kSees = Kind != ParticleLit::kShade&& Kind != ParticleLit::kExact;
template <ParticleLit Kind>
constexpr bool kTints = Kind == ParticleLit::kTinted || Kind == ParticleLit::kTintedExact;
template <ParticleLit Kind>
constexpr int kSumsOf = 5 + (kSees<Kind> ? 1 : 0) + (kTints<Kind> ? 3 : 0);
/// Where the sums of colours begin.
template <ParticleLit Kind>
constexpr int kTintAt = kSumsOf<Kind> - 3;

/// Light that leaves a bin along the rays, per optical depth; `own` are its sums.
template <ParticleLit Kind, class T>
PILEUS_FN void light_of_bin(const ParticleMarchParams& k, const ParticlePhases<T>& phases,
                            const T (&own)[kSumsOf<Kind>], T (&light)[3]) {
    constexpr bool kSeen = kSees<Kind>;
    const T per_depth = 1.0f / max_(own[0], all<T>(1e-30f));
    for (int c = 0; c < 3; ++c) light[c] = k.albedo[c] * (own[c + 2] * per_depth);
    T seen = all<T>(1.0f), shade = own[1] * per_depth;
    if constexpr (kSeen) {
        seen = own[5] * per_depth;
        // Depths of those alone that the sun reaches.
        if constexpr (!kWalks<Kind>) shade = own[1] / max_(own[5], all<T>(1e-30f));
    }
    shade = max_(shade, T{});
    T tint[3] = {}, left[3] = {};
    if constexpr (kTints<Kind>)
        for (int c = 0; c < 3; ++c) tint[c] = left[c] = own[kTintAt<Kind> + c] * per_depth;
    for (int n = 0; n < k.orders; ++n) {
        T arrives = phases.order[n] * exp_(T{} - shade * k.thinner[n]);
        if constexpr (kSeen) arrives = arrives * seen;
        for (int c = 0; c < 3; ++c) {
            T share = arrives;
            if constexpr (kTints<Kind>) {
                share = share * left[c];
                left[c] = left[c] * tint[c];
            }
            light[c] = light[c] + share * k.sun[n][c];
        }
    }
}

/// Bins along W rays: sums of each, all 0 where no ball has been added since they were shown.
template <ParticleLit Kind, class T>
struct ParticleBins {
    float* sums;
    std::int32_t count;  ///< of bins
    T from, width, per_width;
    std::int32_t open = 0;       ///< bins before this are shown
    std::int32_t farthest = -1;  ///< that a ball was added to

    static constexpr std::int32_t kNumbers =
        std::int32_t(sizeof(T) / sizeof(float)) * kSumsOf<Kind>;
    constexpr float* at(std::int32_t n) const { return sums + std::int64_t(n) * kNumbers; }
};

/// What W pixels see so far.
template <class T>
struct ParticlePixels {
    T transmittance, half, depth, colour[3];
};

/// Adds a ball's depth, and its light with it, to the bins that it overlaps.
template <ParticleLit Kind, class T>
PILEUS_FN void add_to_bins(const ParticleMarchParams& k, const ParticleMarchBuffers& b,
                           const ParticleRay<T>& r, std::int32_t i, const BallPass<T>& p,
                           M_of<T> hit, ParticleBins<Kind, T>& bins) {
    using II = I_of<T>;
    const ParticleBall& ball = k.view.balls[i];
    const T radius = all<T>(1.0f / ball.per_radius);
    const auto bin = [&](T s) {
        const T at = (p.along + s * radius - bins.from) * bins.per_width;
        return min_(max_(to_int(select(hit, at, T{})), all<II>(bins.open)),
                    all<II>(bins.count - 1));
    };
    const II own_first = bin(p.begin), own_last = bin(p.end);
    const std::int32_t first = least_lane(own_first, hit);
    const std::int32_t last = largest_lane(own_last, hit);
    bins.farthest = last > bins.farthest ? last : bins.farthest;
    // Depth towards the sun at place s of the ray, in radii: shade + s slope.
    T shade{}, slope{};
    if constexpr (!kWalks<Kind>) {
        const ParticleShade& sun = b.shade[i];
        const Vec<T>& d = r.direction;
        slope = sun.slope[0] * d.x + sun.slope[1] * d.y + sun.slope[2] * d.z;
        const T across = sun.slope[0] * (ball.centre[0] - r.origin.x) +
                         sun.slope[1] * (ball.centre[1] - r.origin.y) +
                         sun.slope[2] * (ball.centre[2] - r.origin.z) - p.along * slope;
        shade = sun.depth - across * ball.per_radius;
    }
    const float seen = kSees<Kind> && dimmed_by_meshes(b.seen) ? b.seen[i] : 1.0f;
    T start = p.begin;
    const T weight = select(hit, all<T>(ball.depth), T{});
    T before = ball_integral(p.inner, p.begin);
    for (std::int32_t n = first; n <= last; ++n) {
        const T edge = bins.from + float(n + 1) * bins.width;
        T s = min_(max_((edge - p.along) * ball.per_radius, p.begin), p.end);
        // A ray's first and last bin are its own, whatever rounding says of their edges.
        s = select(own_first > n, p.begin, select(own_last <= n, p.end, s));
        const T after = ball_integral(p.inner, s);
        const T tau = weight * max_(after - before, T{});
        before = after;
        T own[kSumsOf<Kind>];
        __builtin_memcpy(own, bins.at(n), sizeof own);
        own[0] = own[0] + tau;
        const T middle = 0.5f * (start + s);
        if constexpr (kWalks<Kind>)
            own[1] = own[1] + tau * (p.along + middle * radius);
        else
            own[1] = own[1] + (kSees<Kind> ? tau * seen : tau) * (shade + middle * slope);
        if constexpr (kSees<Kind>) own[5] = own[5] + tau * seen;
        if constexpr (kTints<Kind>)
            for (int c = 0; c < 3; ++c)
                own[kTintAt<Kind> + c] =
                    own[kTintAt<Kind> + c] + tau * b.tint[3 * std::int64_t(i) + c];
        start = s;
        if (b.sky != nullptr)
            for (int c = 0; c < 3; ++c)
                own[c + 2] =
                    own[c + 2] + tau * b.sky[std::uint64_t(c) * b.balls + std::uint64_t(i)];
        __builtin_memcpy(bins.at(n), own, sizeof own);
    }
}

/// Shows bins up to `end`, and empties them. False: nothing behind them is seen.
template <ParticleLit Kind, class T>
PILEUS_FN bool show_bins(const ParticleMarchParams& k, const ParticleMarchBuffers& b,
                         const ParticleRay<T>& r, const ParticlePhases<T>& phases, std::int32_t end,
                         ParticleBins<Kind, T>& bins, ParticlePixels<T>& v) {
    bool seen = true;
    for (std::int32_t n = bins.open; n < end; ++n) {
        T own[kSumsOf<Kind>];
        __builtin_memcpy(own, bins.at(n), sizeof own);
        if (!any(own[0] > 0.0f)) continue;
        const T none[kSumsOf<Kind>] = {};
        __builtin_memcpy(bins.at(n), none, sizeof none);
        if (!seen) continue;
        v.depth = v.depth + own[0];
        const T tau = select(v.transmittance >= k.cut, own[0], T{});
        if (kWalks<Kind> && k.orders > 0)
            own[1] = own[0] * shade_at(k, r, own[1] / max_(own[0], all<T>(1e-30f)), tau > 0.0f);
        const T alpha = one_minus_exp(tau);
        T light[3];
        light_of_bin<Kind>(k, phases, own, light);
        const T weight = v.transmittance * alpha;
        for (int c = 0; c < 3; ++c) v.colour[c] = v.colour[c] + weight * light[c];
        const T left = v.transmittance * (1.0f - alpha);
        const auto crosses = (v.transmittance > 0.5f) & (left <= 0.5f);
        if (b.half_depth != nullptr && any(crosses)) {
            const T share = log_(v.transmittance * 2.0f) / max_(tau, all<T>(1e-30f));
            v.half = select(crosses, bins.from + (float(n) + share) * bins.width, v.half);
        }
        v.transmittance = left;
        seen = b.optical_depth != nullptr || any(v.transmittance >= k.cut);
    }
    bins.open = end > bins.open ? end : bins.open;
    return seen;
}

/// Looks at balls between two looks at which bins are whole.
constexpr std::int32_t kBallsBetween = 8;

/// The balls of `seen`, which lie sorted by where rays may first meet them: bins before that are
/// whole, and where nothing is seen behind them the rest is left out.
template <ParticleLit Kind, class T>
PILEUS_FN void march_seen(const ParticleMarchParams& k, const ParticleMarchBuffers& b,
                          const ParticleSeen* seen, std::int32_t count, const ParticleRay<T>& r,
                          const ParticlePhases<T>& phases, M_of<T> wanted,
                          ParticleBins<Kind, T>& bins, ParticlePixels<T>& v) {
    // Of all lanes: the farthest begin, the widest bin, the farthest end.
    float from = 0, width = 0, to = 0;
    for (std::uint32_t lanes = bits_of(wanted); lanes != 0; lanes &= lanes - 1) {
        const int l = lowest_bit(lanes);
        from = lane(r.from, l) > from ? lane(r.from, l) : from;
        to = lane(r.to, l) > to ? lane(r.to, l) : to;
        width = lane(bins.width, l) > width ? lane(bins.width, l) : width;
    }
    const float per_width = 1.0f / width;
    for (std::int32_t j = 0; j < count; ++j) {
        const ParticleSeen& own = seen[j];
        if (j % kBallsBetween == 0) {
            if (own.front > to) break;
            const float whole = (own.front - from) * per_width;
            // A bin less, for rounding.
            const std::int32_t end =
                whole > 1 ? (whole < float(bins.count) ? std::int32_t(whole) - 1 : bins.count) : 0;
            if (end > bins.open &&
                !show_bins<Kind>(k, b, r, phases, end <= bins.farthest ? end : bins.farthest + 1,
                                 bins, v))
                break;
        }
        BallPass<T> p = near_ball(k.view.balls[own.ball], r);
        auto hit = wanted & (p.inner > 0.0f);
        if (!any(hit)) continue;
        pass_ball(k.view.balls[own.ball], r, p);
        hit = hit & (p.begin < p.end);
        if (any(hit)) add_to_bins<Kind>(k, b, r, std::int32_t(own.ball), p, hit, bins);
    }
}

/// W pixels, a block from column x and row y on, within a rectangle.
template <int W, ParticleLit Kind>
PILEUS_FN void particle_pixels(const ParticleMarchParams& k, const ParticleMarchBuffers& b,
                               const ParticleTile& tile, std::int32_t x, std::int32_t y) {
    using T = F<W>;
    const I<W> number = iota<I<W>>();
    const I<W> column = number % kMarchAcross<W> + x, row = number / kMarchAcross<W> + y;
    const M<W> real = (column < tile.x_end) & (row < tile.y_end);
    const std::int64_t pixels = std::int64_t(k.camera.width) * k.camera.height;
    const Ray<T> ray = camera_ray(k.camera, to_float(column), to_float(row));
    T most = all<T>(3e38f);
    if (b.opaque_depth != nullptr)
        for_block<W>(k.camera, x, y, tile.y_end,
                     [&](int l, std::int64_t pixel) { set_lane(most, l, b.opaque_depth[pixel]); });
    ParticleRay<T> r = particle_ray(ray.origin, ray.direction, T{}, most);
    const ParticleSegment<T> box = within_box(k.view.nodes[0], r);
    const M<W> met = real & (box.enter < box.leave);
    r.from = box.enter, r.to = box.leave;

    ParticlePixels<T> v{};
    v.transmittance = all<T>(1.0f), v.half = all<T>(__builtin_inff());
    if (any(met) && tile.count != 0) {
        ParticleBins<Kind, T> bins{};
        bins.sums = b.scratch;
        bins.count = k.bins;
        bins.from = box.enter;
        bins.width = select(met, (box.leave - box.enter) * (1.0f / float(k.bins)), all<T>(1.0f));
        bins.per_width = 1.0f / bins.width;
        const ParticlePhases<T> phases = particle_phases(k, ray.direction);
        if (tile.seen != nullptr)
            march_seen<Kind>(k, b, tile.seen, tile.count, r, phases, met, bins, v);
        else
            walk_particles(k.view, r, met, [&](std::int32_t i, const BallPass<T>& p, M<W> hit) {
                add_to_bins<Kind>(k, b, r, i, p, hit, bins);
                return hit & lnot(hit);
            });
        (void)show_bins<Kind>(k, b, r, phases, bins.farthest + 1, bins, v);
    }
    for_block<W>(k.camera, x, y, tile.y_end, [&](int l, std::int64_t pixel) {
        b.transmittance[pixel] = lane(v.transmittance, l);
        if (b.half_depth != nullptr) b.half_depth[pixel] = lane(v.half, l);
        if (b.optical_depth != nullptr) b.optical_depth[pixel] = lane(v.depth, l);
        for (int c = 0; c < 3; ++c) b.colour[c * pixels + pixel] = lane(v.colour[c], l);
    });
}

template <int W>
PILEUS_FN void particle_tile(const ParticleMarchParams& k, const ParticleMarchBuffers& b,
                             const ParticleTile& tile) {
    constexpr int across = kMarchAcross<W>;
    for (std::int32_t y = tile.y_begin; y < tile.y_end; y += W / across)
        for (std::int32_t x = tile.x_begin; x < tile.x_end; x += across)
            if (b.tint != nullptr && k.exact != 0)
                particle_pixels<W, ParticleLit::kTintedExact>(k, b, tile, x, y);
            else if (b.tint != nullptr)
                particle_pixels<W, ParticleLit::kTinted>(k, b, tile, x, y);
            else if (k.exact != 0 && dimmed_by_meshes(b.seen))
                particle_pixels<W, ParticleLit::kSeenExact>(k, b, tile, x, y);
            else if (k.exact != 0)
                particle_pixels<W, ParticleLit::kExact>(k, b, tile, x, y);
            else if (dimmed_by_meshes(b.seen))
                particle_pixels<W, ParticleLit::kSeen>(k, b, tile, x, y);
            else
                particle_pixels<W, ParticleLit::kShade>(k, b, tile, x, y);
}

/// Tiles [begin, end) of b.tiles.
template <int W>
PILEUS_FN void particle_tiles(const ParticleMarchParams& k, const ParticleTileBuffers& b,
                              std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) particle_tile<W>(k, b.march, b.tiles[i]);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
