// SPDX-License-Identifier: Apache-2.0
// Rays through a tree of particles: which balls each meets, and how much of them.
// in: W rays, a tree -> out: balls, and integrals of their extinction along pieces of a ray.
// Monette and Whitehead 2014, 3; docs/particles.md, "Rays". Particles are broadcast, lanes are
// rays: rays that stay together share the walk, and what one finds does not depend on the others.
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/particles/particle_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// A ray from `from` on for `to` metres along a unit direction.
template <class T>
struct ParticleRay {
    Vec<T> origin, direction, inverse;
    T from, to;
};

template <class T>
PILEUS_FN ParticleRay<T> particle_ray(const Vec<T>& origin, const Vec<T>& direction, T from, T to) {
    const auto inverse = [](T d) { return 1.0f / copysign_(max_(abs_(d), all<T>(1e-18f)), d); };
    return {origin,
            direction,
            {inverse(direction.x), inverse(direction.y), inverse(direction.z)},
            from,
            to};
}

/// Where a ray is within a box, metres.
template <class T>
struct ParticleSegment {
    T enter, leave;
};
template <class T>
PILEUS_FN ParticleSegment<T> within_box(const ParticleNode& n, const ParticleRay<T>& r) {
    const T ax = (n.low[0] - r.origin.x) * r.inverse.x, bx = (n.high[0] - r.origin.x) * r.inverse.x;
    const T ay = (n.low[1] - r.origin.y) * r.inverse.y, by = (n.high[1] - r.origin.y) * r.inverse.y;
    const T az = (n.low[2] - r.origin.z) * r.inverse.z, bz = (n.high[2] - r.origin.z) * r.inverse.z;
    return {max_(max_(min_(ax, bx), min_(ay, by)), max_(min_(az, bz), r.from)),
            min_(min_(max_(ax, bx), max_(ay, by)), min_(max_(az, bz), r.to))};
}

/// How a ray passes a ball: places along it in radii from the nearest one to the centre.
template <class T>
struct BallPass {
    T along;       ///< metres to that place
    T inner;       ///< 1 - (distance from the centre)^2 in radii; above 0 within
    T begin, end;  ///< of the ray's piece within the ball
};
/// `along` and `inner` alone: most balls are missed.
template <class T>
PILEUS_FN BallPass<T> near_ball(const ParticleBall& b, const ParticleRay<T>& r) {
    const Vec<T> p{b.centre[0] - r.origin.x, b.centre[1] - r.origin.y, b.centre[2] - r.origin.z};
    BallPass<T> s{};
    s.along = dot(p, r.direction);
    const Vec<T> q{p.x - s.along * r.direction.x, p.y - s.along * r.direction.y,
                   p.z - s.along * r.direction.z};
    s.inner = 1.0f - dot(q, q) * (b.per_radius * b.per_radius);
    return s;
}
template <class T>
PILEUS_FN void pass_ball(const ParticleBall& b, const ParticleRay<T>& r, BallPass<T>& s) {
    const T half = sqrt_(max_(s.inner, T{}));
    s.begin = max_((r.from - s.along) * b.per_radius, T{} - half);
    s.end = min_((r.to - s.along) * b.per_radius, half);
}

/// Integral of (inner - s^2)^2 from 0 to s.
template <class T>
PILEUS_FN T ball_integral(T inner, T s) {
    const T square = s * s;
    return s * (inner * inner - square * (inner * (2.0f / 3.0f) - square * 0.2f));
}

/// Calls visit(number of the ball, its pass, lanes that meet it) for all balls in the order of the
/// tree; visit returns the lanes that are done. `wanted` lanes alone.
template <class T, class Visit>
PILEUS_FN void walk_particles(const ParticleView& v, const ParticleRay<T>& r, M_of<T> wanted,
                              Visit visit) {
    using II = I_of<T>;
    // A lane that has missed a node sleeps until its walk would go on.
    II awake_at = select(wanted, II{}, all<II>(v.node_count));
    std::int32_t at = 0;
    while (at < v.node_count) {
        const ParticleNode& n = v.nodes[at];
        const ParticleSegment<T> s = within_box(n, r);
        const auto awake = awake_at <= at;
        const auto meets = awake & (s.enter <= s.leave);
        if (!any(meets)) {
            at = n.skip;
            continue;
        }
        awake_at = select(awake & lnot(meets), all<II>(n.skip), awake_at);
        ++at;
        if (n.skip != at) continue;
        const std::int32_t end = v.nodes[at].first;
        for (std::int32_t i = n.first; i < end; ++i) {
            BallPass<T> p = near_ball(v.balls[i], r);
            auto hit = meets & (p.inner > 0.0f);
            if (!any(hit)) continue;
            pass_ball(v.balls[i], r, p);
            hit = hit & (p.begin < p.end);
            if (!any(hit)) continue;
            const auto done = visit(i, p, hit);
            awake_at = select(done, all<II>(v.node_count), awake_at);
        }
    }
}

/// Optical depth of the rays; what is deeper than `most` is as deep as it is when that is noticed.
/// `wanted` lanes alone.
template <class T>
PILEUS_FN T particle_depth(const ParticleView& v, const ParticleRay<T>& r, M_of<T> wanted,
                           float most) {
    T tau{};
    walk_particles(v, r, wanted, [&](std::int32_t i, const BallPass<T>& p, M_of<T> hit) {
        const T way = ball_integral(p.inner, p.end) - ball_integral(p.inner, p.begin);
        tau = tau + select(hit, v.balls[i].depth * way, T{});
        return hit & (tau >= most);
    });
    return tau;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
