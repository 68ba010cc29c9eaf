// SPDX-License-Identifier: Apache-2.0
// Optical depth from every particle towards a light far away.
// in: a tree, a direction -> out: a depth for each ball.
// Monette and Whitehead 2014, 3.3; docs/particles.md, "Light".
#pragma once
#include "kernels_cpu/particles/particle_walk.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Balls [begin, end). Those side by side in the tree lie side by side: their rays share a walk.
template <int W>
PILEUS_FN void particle_depths(const ParticleDepthParams& k, const ParticleDepthBuffers& b,
                               std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    const Vec<T> direction{all<T>(k.direction[0]), all<T>(k.direction[1]), all<T>(k.direction[2])};
    for (std::uint32_t first = begin; first < end; first += W) {
        Vec<T> origin{};
        const I<W> number = iota<I<W>>();
        const M<W> real = number < std::int32_t(end - first);
        for (int l = 0; l < W; ++l) {
            const std::uint32_t own =
                first + std::uint32_t(l) < end ? first + std::uint32_t(l) : first;
            const ParticleBall& ball = k.view.balls[own];
            const float radius = 1.0f / ball.per_radius;
            set_lane(origin.x, l, ball.centre[0] + k.offset[0] * radius);
            set_lane(origin.y, l, ball.centre[1] + k.offset[1] * radius);
            set_lane(origin.z, l, ball.centre[2] + k.offset[2] * radius);
        }
        const ParticleRay<T> ray = particle_ray(origin, direction, T{}, all<T>(3e38f));
        const T tau = particle_depth(k.view, ray, real, k.most);
        for (int l = 0; l < W; ++l)
            if (first + std::uint32_t(l) < end) b.depth[first + std::uint32_t(l)] = lane(tau, l);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
