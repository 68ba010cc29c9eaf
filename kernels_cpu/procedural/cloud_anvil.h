// SPDX-License-Identifier: Apache-2.0
// The anvil of a cumulonimbus: a bent lens of ice with a flat top, drawn out downwind into fibres.
// in: lanes of places, a heap's surface -> out: the surface of both, shares of ice.
// docs/generators.md, "Anvil"; Cotton, Bryan, van den Heever 2011, ch. 8.
#pragma once
#include "kernels_cpu/procedural/cloud_lumps.h"
#include "kernels_cpu/procedural/cloud_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

// In heights of the cloud.
constexpr float kAnvilJoin = 0.05f;   // width over which it joins the tower
constexpr float kAnvilEdge = 0.02f;   // of its rim
constexpr float kAnvilReach = 1.75f;  // in radii: how far fibres reach downwind

/// Whether cells at distance `radius` of a centre can lie in the anvil or its edge.
PILEUS_FN bool near_anvil(const CloudParams& k, const float* centre, float radius, float reach) {
    if (!(k.anvil_radius > 0.0f)) return false;
    const float x = centre[0] - k.anvil_x, y = centre[1] - k.anvil_y;
    const float far = sqrt_(x * x + y * y),
                margin = radius + reach + kAnvilJoin * k.height + k.plan;
    return far < kAnvilReach * k.anvil_radius + margin && centre[2] < k.anvil_top + margin &&
           centre[2] > k.anvil_top - k.anvil_depth - margin;
}

/// What an anvil is at a place.
template <class T>
struct AnvilShare {
    T ice;  ///< 0: the tower, 1: the anvil
    T rim;  ///< distance from its middle over its radius, with fibres
};

template <class T>
PILEUS_FN AnvilShare<T> join_anvil(const CloudParams& k, const Vec<T>& p, CloudSurface<T>& s,
                                   T& act) {
    const T one = all<T>(1.0f);
    const T x = p.x - k.anvil_x, y = p.y - k.anvil_y;
    const T along = x * k.wind_x + y * k.wind_y, across = y * k.wind_x - x * k.wind_y;
    const T lee = along * select(along > 0.0f, all<T>(0.75f), all<T>(1.35f));
    const T r = max_(sqrt_(lee * lee + across * across), all<T>(1.0f));
    // Fibres: noise that changes with the direction more than with the distance.
    const T per_r = 1.0f / r, slow = r * (1.4f / k.anvil_radius);
    const T cosine = lee * per_r, sine = across * per_r;
    const T fibres =
        gradient_noise<T>(cosine * 7.0f, sine * 7.0f, slow, k.seed + 45u) +
        0.5f * gradient_noise<T>(cosine * 17.0f, sine * 17.0f, slow * 1.5f, k.seed + 46u) +
        0.25f * gradient_noise<T>(cosine * 41.0f, sine * 41.0f, slow * 2.0f, k.seed + 47u);
    const T rim = r * (1.0f / k.anvil_radius) + 0.22f * fibres;
    const T inside = max_(one - rim, T{});
    const T depth = k.anvil_depth * sqrt_(inside) * (1.0f - 0.45f * min_(rim, one));
    const T over = p.z - k.anvil_top, under = (k.anvil_top - depth) - p.z;
    const T beside = (rim - 1.0f) * (0.4f * k.anvil_radius);
    const T d = max_(max_(over, under), beside) + k.anvil_sunk;
    const float join = kAnvilJoin * k.height;
    const T ice = smooth_ramp<T>(0.5f + (s.distance - d) * (1.0f / join));
    const auto nearer = d < s.distance;
    s.normal.x = select(nearer, T{}, s.normal.x);
    s.normal.y = select(nearer, T{}, s.normal.y);
    s.normal.z = select(nearer, select(over > under, one, all<T>(-1.0f)), s.normal.z);
    s.distance = blend_min(s.distance, d, all<T>(join), all<T>(0.25f / join));
    // Smooth above and at the rim, with lumps that hang below.
    const T hung = 0.6f * max_(1.0f - 0.8f * rim, T{});
    act = act + ice * (select(over > under, all<T>(0.12f), hung) - act);
    return {ice, rim};
}

/// Density of ice: a quarter of the fullest water in the middle, an eighth of that at the rim.
template <class T>
PILEUS_FN T anvil_density(const CloudParams& k, T d, T rim) {
    const T edge = smooth_ramp<T>(0.5f - d * (1.0f / (kAnvilEdge * k.height)));
    return edge * 0.25f * (1.0f - 0.88f * smooth_ramp<T>(rim));
}

}  // namespace PILEUS_ISA
}  // namespace pileus
