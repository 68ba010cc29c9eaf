// SPDX-License-Identifier: Apache-2.0
// Light of points, spots and parallel lights in particles.
// in: a tree, lamps -> out: depths from each ball to a lamp; light that balls scatter.
// Monette and Whitehead 2014, 3.3; docs/particles.md, "Lights".
#pragma once
#include "kernels_cpu/core/meshes.h"
#include "kernels_cpu/light/lamp_sphere.h"
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

/// The places in them that `k` looks from.
template <int W>
PILEUS_FN Vec<F<W>> lit_places(const ParticleLampDepths& k, std::uint32_t first,
                               std::uint32_t end) {
    using T = F<W>;
    const float none[3] = {};
    T radius{};
    if (k.turned == 0) return ball_places<W>(k.view, k.offset, first, end, radius);
    const Vec<T> p = ball_places<W>(k.view, none, first, end, radius);
    const Vec<T> way{k.lamp.at[0] - p.x, k.lamp.at[1] - p.y, k.lamp.at[2] - p.z};
    const Vec<T> moved = along_axes(light_axes(way), k.offset);
    return {p.x + moved.x * radius, p.y + moved.y * radius, p.z + moved.z * radius};
}

/// A turn of a sphere's places that belongs to a ball wherever it stands in a list.
PILEUS_FN float turn_of_ball(const ParticleBall& ball) {
    const auto bits = [](float v) { return reinterpret<std::uint32_t>(v); };
    const std::uint32_t more = bits(ball.centre[2]) ^ bits(ball.per_radius);
    return turn_of_spiral(bits(ball.centre[0]) ^ rotate_left<16>(bits(ball.centre[1])), more);
}
template <int W>
PILEUS_FN F<W> turns_of_balls(const ParticleView& v, std::uint32_t first, std::uint32_t end) {
    F<W> turn{};
    for (int l = 0; l < W; ++l)
        set_lane(turn, l,
                 turn_of_ball(
                     v.balls[first + std::uint32_t(l) < end ? first + std::uint32_t(l) : first]));
    return turn;
}

/// Balls [begin, end): walks to the lamp, or to places on it, W side by side.
template <int W>
PILEUS_FN void particle_lamp_depths(const ParticleLampDepths& k, const ParticleLampDepthBuffers& b,
                                    std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    for (std::uint32_t first = begin; first < end; first += W) {
        const Vec<T> p = lit_places<W>(k, first, end);
        const auto depth_to = [&](const LampSight<T>& sight) {
            return min_(particle_depth(k.view, particle_ray(p, sight.way, T{}, sight.distance),
                                       sight.share > 0.0f, k.most),
                        all<T>(k.most));
        };
        T tau{};
        if (k.lamp.radius > 0.0f) {
            const T turn = turns_of_balls<W>(k.view, first, end);
            const LampCone<T> cone = lamp_cone(k.lamp, p);
            MeanDepth<T> mean{};
            for (std::int32_t i = 0; i < k.lamp.places; ++i)
                add_depth(mean, depth_to(lamp_place(k.lamp, cone, i, turn)), i == 0);
            tau = mean_depth(mean, k.lamp.places);
        } else {
            tau = depth_to(see_lamp(k.lamp, p));
        }
        for (int l = 0; l < W; ++l)
            if (first + std::uint32_t(l) < end) b.depth[first + std::uint32_t(l)] = lane(tau, l);
    }
}

/// Mean of 1 / distance^2 over a ball's extinction, from its centre: 7 / radius^2.
constexpr float kNearestSquare = 1.0f / 7;

/// A sphere as balls see it: bounded as a point is, and dark for what of a ball lies within the
/// sphere, as if its extinction were spread evenly over its width; a small sphere takes its volume.
template <class T>
PILEUS_FN LampCone<T> cone_of_balls(const LampParams& lamp, const Vec<T>& p, T radius) {
    LampCone<T> cone = lamp_cone(lamp, p);
    const float square = lamp.radius * lamp.radius;
    const T far = max_(max_(cone.distance * cone.distance, all<T>(square)),
                       kNearestSquare * (radius * radius));
    const T ratio = min_(lamp.radius / radius, all<T>(1.0f));
    const T width = (cone.distance + radius - lamp.radius) / (2.0f * radius);
    const T outside = max_(min_(max_(width, T{}), all<T>(1.0f)), 1.0f - ratio * ratio * ratio);
    cone.share = outside * 2.0f / (far * (1.0f + sqrt_(max_(1.0f - square / far, T{}))));
    return cone;
}

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
            T depth{}, reach{}, share = sight.share, phases[kMaxParticleOrders] = {};
            const std::uint64_t at = std::uint64_t(n) * b.balls;
            for (int l = 0; l < W; ++l) {
                set_lane(depth, l, number(b.depth + at, l));
                set_lane(reach, l, number(b.reach + at, l));
            }
            const T most = most_density(c, to);
            const auto phase_of = [&](int order, T turn) {
                return min_(order == 0 ? phase_density(k.phase, turn)
                                       : hg_density(all<T>(k.order_g[order]), turn),
                            most);
            };
            if (lamp.radius > 0.0f) {
                LampCone<T> cone = cone_of_balls(lamp, p, radius);
                if (!any(most_share(lamp, cone) > 0.0f)) continue;
                // Falloff and phase function are means over the places.
                cone.share = cone.share * (1.0f / float(lamp.places));
                share = all<T>(1.0f);
                const T spiral = turns_of_balls<W>(k.view, first, end);
                for (std::int32_t i = 0; i < lamp.places; ++i) {
                    const LampSight<T> place = lamp_place(lamp, cone, i, spiral);
                    const T turn = one_minus_cosine(to, place.way);
                    for (int order = 0; order < b.orders; ++order)
                        phases[order] = phases[order] + place.share * phase_of(order, turn);
                }
            } else {
                if (!any(share > 0.0f)) continue;
                if (lamp.parallel == 0) {
                    const T least = kNearestSquare * (radius * radius);
                    const T square =
                        max_(sight.distance * sight.distance, all<T>(lamp.least_square));
                    share = share * (square / max_(square, least));
                }
                const T turn = one_minus_cosine(to, sight.way);
                for (int order = 0; order < b.orders; ++order)
                    phases[order] = phase_of(order, turn);
            }
            if (dimmed_by_meshes(b.seen))
                for (int l = 0; l < W; ++l)
                    set_lane(share, l, lane(share, l) * number(b.seen + at, l));
            T left[3];
            for (T& one : left) one = all<T>(1.0f);
            for (int order = 0; order < b.orders; ++order) {
                const T arrives =
                    share * phases[order] * mean_light(depth, reach, k.thinner[order]);
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
