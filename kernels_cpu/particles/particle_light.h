// SPDX-License-Identifier: Apache-2.0
// Optical depth from places among particles towards a light far away.
// in: places, the balls that may lie in their way -> out: a depth for each place.
// Monette and Whitehead 2014, 3.3; docs/particles.md, "Light".
#pragma once
#include "kernels_cpu/particles/particle_walk.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Axes of places in a ball: w towards its light, u level. What mirrors a light and balls in a
/// plane that is level or upright along an axis mirrors them, too, or turns one of u and v about.
template <class T>
struct LightAxes {
    Vec<T> u, v, w;
};
template <class T>
PILEUS_FN LightAxes<T> light_axes(const Vec<T>& way) {
    const T least = all<T>(1e-30f), flat = way.x * way.x + way.y * way.y;
    const T square = flat + way.z * way.z;
    const T per = 1.0f / sqrt_(max_(square, least));
    // A light straight above or below: x is as good as any.
    const M_of<T> leans = flat > max_(square * 1e-12f, least);
    const T level = 1.0f / sqrt_(max_(flat, least));
    LightAxes<T> a{};
    a.w = {way.x * per, way.y * per, way.z * per};
    a.u = {select(leans, way.y * level, all<T>(1.0f)), select(leans, T{} - way.x * level, T{}),
           T{}};
    a.v = {T{} - a.w.z * a.u.y, a.w.z * a.u.x, a.w.x * a.u.y - a.w.y * a.u.x};
    return a;
}
/// `offset` along the axes.
template <class T>
PILEUS_FN Vec<T> along_axes(const LightAxes<T>& a, const float (&offset)[3]) {
    return {a.u.x * offset[0] + a.v.x * offset[1] + a.w.x * offset[2],
            a.u.y * offset[0] + a.v.y * offset[1] + a.w.y * offset[2],
            a.u.z * offset[0] + a.v.z * offset[1] + a.w.z * offset[2]};
}

/// Places along the gradient of the depth towards a light, and their weights, that have the first
/// even moments of a ball's extinction along an axis, 1/9 and 1/33.
constexpr float kShadeAt = 0.522232968f, kShadeWeight = 11.0f / 54;

/// Mean over a ball's extinction of e^-(thinner depth), where the depth is `depth` at the centre
/// and grows by `reach` over a radius.
template <class T>
PILEUS_FN T mean_light(T depth, T reach, float thinner) {
    const T offset = kShadeAt * reach;
    const auto light = [&](T at) { return exp_(T{} - max_(at, T{}) * thinner); };
    return (1.0f - 2 * kShadeWeight) * light(depth) +
           kShadeWeight * (light(depth - offset) + light(depth + offset));
}

/// Of vectors [ball][channel] those of balls from `first` on, a lane each; null: 1.
template <int W>
PILEUS_FN F<W> lanes_of_balls(const float* vectors, int channel, std::uint32_t first,
                              std::uint32_t end) {
    F<W> value = all<F<W>>(1.0f);
    for (int l = 0; l < W && vectors != nullptr; ++l) {
        const std::uint32_t i = first + std::uint32_t(l) < end ? first + std::uint32_t(l) : first;
        set_lane(value, l, vectors[3 * std::uint64_t(i) + std::uint64_t(channel)]);
    }
    return value;
}

/// Occluders between two looks at whether all places are as deep as it counts.
constexpr std::int32_t kLookAgain = 16;

/// Places [begin, end), W side by side. What a pair of place and ball adds depends on these two
/// alone, and a ball that is missed adds 0: neither neighbours nor lanes change a bit.
template <int W>
PILEUS_FN void particle_depths(const ParticleDepthParams& k, const ParticleDepthBuffers& b,
                               std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    for (std::uint32_t first = begin; first < end; first += W) {
        T u{}, v{}, w{}, tau{};
        float nearest = -3e38f, farthest = 3e38f;
        for (int l = 0; l < W; ++l) {
            const std::uint32_t own =
                first + std::uint32_t(l) < end ? first + std::uint32_t(l) : first;
            set_lane(u, l, b.u[own]), set_lane(v, l, b.v[own]), set_lane(w, l, b.w[own]);
            set_lane(tau, l, b.depth[own]);
            nearest = b.w[own] > nearest ? b.w[own] : nearest;
            farthest = b.w[own] < farthest ? b.w[own] : farthest;
        }
        for (std::int32_t i = 0; i < k.count; ++i) {
            const ParticleOccluder& o = k.occluders[i];
            if (o.back <= farthest) break;
            const T x = u - o.u, y = v - o.v;
            const T inner = max_(1.0f - (x * x + y * y) * o.per_square, T{});
            if (o.front >= nearest) {
                // All of it lies before each place.
                tau = tau + o.whole * (inner * inner * sqrt_(inner));
                if (i % kLookAgain == 0 && !any(tau < k.most)) break;
                continue;
            }
            if (!any(inner > 0.0f)) continue;
            const T half = sqrt_(inner);
            const T from = min_(max_((w - o.w) * o.per_radius, T{} - half), half);
            const T part = (o.whole * (15.0f / 16)) *
                           max_(ball_integral(inner, half) - ball_integral(inner, from), T{});
            const T whole = o.whole * (inner * inner * half);
            tau = tau + select(w <= o.front, whole, select(w < o.back, part, T{}));
        }
        for (int l = 0; l < W; ++l)
            if (first + std::uint32_t(l) < end)
                b.depth[first + std::uint32_t(l)] = lane(min_(tau, all<T>(k.most)), l);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
