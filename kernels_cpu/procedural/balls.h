// SPDX-License-Identifier: Apache-2.0
// Distances to balls, which have a middle x, y, z and a radius r.
// in: lanes of places, numbers of the balls that count -> out: signed distances, negative inside.
#pragma once
#include "kernels_cpu/core/vec.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <class T, class Ball>
PILEUS_FN T ball_distance(const Vec<T>& p, const Ball& b) {
    const T x = p.x - b.x, y = p.y - b.y, z = p.z - b.z;
    return sqrt_(x * x + y * y + z * z) - b.r;
}

/// The least of those named by `near`.
template <class T, class Ball>
PILEUS_FN T nearest_ball(const Vec<T>& p, const Ball* balls, const std::int32_t* near,
                         std::int32_t count) {
    T d = all<T>(1e9f);
    for (std::int32_t i = 0; i < count; ++i) d = min_(d, ball_distance(p, balls[near[i]]));
    return d;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
