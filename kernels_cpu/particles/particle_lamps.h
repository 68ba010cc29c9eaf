// SPDX-License-Identifier: Apache-2.0
// Light of points, spots and parallel lights in particles.
// in: a tree, lamps -> out: depths from each ball to a lamp; light that balls scatter.
// Monette and Whitehead 2014, 3.3; docs/particles.md, "Lights".
#pragma once
#include "kernels_cpu/light/lamp.h"
#include "kernels_cpu/particles/particle_light.h"
#include "kernels_cpu/particles/particle_march.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Centres of W balls from `first` on, moved by `offset` radii; and the radii.
template <int W>
PILEUS_FN Vec<F<W>> ball_places(const ParticleView& v, const float (&offset)[3],
                                std::uint32_t first, std::uint32_t end, F<W>& radius) {
    Vec<F<W>> p{};
    for (int l = 0; l < W; ++l) {
        const std::uint32_t i = first + std::uint32_t(l) < end ? first + std::uint32_t(l) : first;
        const ParticleBall& ball = v.balls[i];
        const float own = 1.0f / ball.per_radius;
        set_lane(radius, l, own);
        set_lane(p.x, l, ball.centre[0] + offset[0] * own);
        set_lane(p.y, l, ball.centre[1] + offset[1] * own);
        set_lane(p.z, l, ball.centre[2] + offset[2] * own);
    }
    return p;
}

/// Balls [begin, end): walks to the lamp, W side by side.
template <int W>
PILEUS_FN void particle_lamp_depths(const ParticleLampDepths& k, std::uint32_t begin,
                                    std::uint32_t end) {
    using T = F<W>;
    for (std::uint32_t first = begin; first < end; first += W) {
        T radius{};
        const Vec<T> p = ball_places<W>(k.view, k.offset, first, end, radius);
        const LampSight<T> sight = see_lamp(k.lamp, p);
        const T tau = particle_depth(k.view, particle_ray(p, sight.way, T{}, sight.distance),
                                     sight.share > 0.0f, k.most);
        for (int l = 0; l < W; ++l)
            if (first + std::uint32_t(l) < end)
                k.depth[first + std::uint32_t(l)] = lane(min_(tau, all<T>(k.most)), l);
    }
}

/// Mean of 1 / distance^2 over a ball's extinction, from its centre: 7 / radius^2.
constexpr float kNearestSquare = 1.0f / 7;

/// Balls [begin, end), W side by side.
template <int W>
PILEUS_FN void particle_lamp_light(const ParticleMarchParams& k, const ParticleLampLight& b,
                                   std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    const CameraParams& c = k.camera;
    const float none[3] = {};
    for (std::uint32_t first = begin; first < end; first += W) {
        T radius{};
        const Vec<T> p = ball_places<W>(k.view, none, first, end, radius);
        Vec<T> to{all<T>(c.forward[0]), all<T>(c.forward[1]), all<T>(c.forward[2])};
        if (c.orthographic == 0) {
            const Vec<T> way{p.x - c.origin[0], p.y - c.origin[1], p.z - c.origin[2]};
            const T per = 1.0f / sqrt_(max_(dot(way, way), all<T>(1e-30f)));
            to = {way.x * per, way.y * per, way.z * per};
        }
        const auto number = [&](const float* from, int l) {
            return from[first + std::uint32_t(l) < end ? first + std::uint32_t(l) : first];
        };
        T light[3] = {}, tint[3];
        for (int i = 0; i < 3; ++i) tint[i] = lanes_of_balls<W>(b.tint, i, first, end);
        for (int l = 0; l < W && b.sky != nullptr; ++l)
            for (int i = 0; i < 3; ++i)
                set_lane(light[i], l, number(b.sky + std::uint64_t(i) * b.balls, l));
        for (std::int32_t n = 0; n < b.count; ++n) {
            const LampParams& lamp = b.lamps[n];
            const LampSight<T> sight = see_lamp(lamp, p);
            if (!any(sight.share > 0.0f)) continue;
            T depth{}, reach{}, share = sight.share;
            const std::uint64_t at = std::uint64_t(n) * b.balls;
            for (int l = 0; l < W; ++l) {
                set_lane(depth, l, number(b.depth + at, l));
                set_lane(reach, l, number(b.reach + at, l));
            }
            if (lamp.parallel == 0) {
                const T least = kNearestSquare * (radius * radius);
                const T square = max_(sight.distance * sight.distance, all<T>(lamp.least_square));
                share = share * (square / max_(square, least));
            }
            if (b.seen != nullptr)
                for (int l = 0; l < W; ++l)
                    set_lane(share, l, lane(share, l) * number(b.seen + at, l));
            const T turn = one_minus_cosine(to, sight.way);
            T left[3];
            for (T& one : left) one = all<T>(1.0f);
            for (int order = 0; order < b.orders; ++order) {
                const T phase = order == 0 ? phase_density(k.phase, turn)
                                           : hg_density(all<T>(k.order_g[order]), turn);
                const T arrives = share * phase * mean_light(depth, reach, k.thinner[order]);
                for (int i = 0; i < 3; ++i) {
                    light[i] = light[i] + arrives * (left[i] * (b.share[order][i] * lamp.light[i]));
                    left[i] = left[i] * tint[i];
                }
            }
        }
        for (int l = 0; l < W; ++l)
            if (first + std::uint32_t(l) < end)
                for (int i = 0; i < 3; ++i)
                    b.light[std::uint64_t(i) * b.balls + first + std::uint32_t(l)] =
                        lane(light[i], l);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
