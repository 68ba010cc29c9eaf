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
constexpr float kMammaCell = 0.085f;  // width of a pouch

/// Whether cells at distance `radius` of a centre can lie in the anvil or its edge.
PILEUS_FN bool near_anvil(const CloudParams& k, const float* centre, float radius, float reach) {
    if (!(k.anvil_radius > 0.0f)) return false;
    const float x = centre[0] - k.anvil_x, y = centre[1] - k.anvil_y;
    const float far = sqrt_(x * x + y * y),
                margin = radius + reach + kAnvilJoin * k.height + k.plan + k.mamma;
    return far < kAnvilReach * k.anvil_radius + margin && centre[2] < k.anvil_top + margin &&
           centre[2] > k.anvil_top - k.anvil_depth - margin;
}

/// What an anvil is at a place.
template <class T>
struct AnvilShare {
    T ice;   ///< 0: the tower, 1: the anvil
    T rim;   ///< distance from its middle over its radius, with fibres
    T hung;  ///< how much of pouches hangs below, 0 to 1
};

/// Pouches that hang from a plane, in their full depth: of bowls strewn one per cell the deepest,
/// so that creases part them.
template <class T>
PILEUS_FN T pouches(T x, T y, std::uint32_t seed) {
    const auto ix = floor_int(x), iy = floor_int(y);
    const T fx = x - to_float(ix), fy = y - to_float(iy);
    const auto place = lattice_place(ix, iy, ix * 0);
    T deepest{};
    for (int c = 0; c < 9; ++c) {
        const int cx = c % 3 - 1, cy = c / 3 - 1;
        const auto h = lattice_hash(place, cx, cy, 0, seed);
        const T dx = hash_share(h, 0) * 0.7f + (float(cx) + 0.15f) - fx;
        const T dy = hash_share(h, 10) * 0.7f + (float(cy) + 0.15f) - fy;
        const T r = 0.45f + 0.45f * hash_share(h, 20);
        const T inside = max_(1.0f - (dx * dx + dy * dy) / (r * r), T{});
        deepest = max_(deepest, r * (1 / 0.9f) * inside * (1.4f - 0.4f * inside));
    }
    return deepest;
}

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
    T hang{}, deep = depth;
    if (k.mamma > 0.0f) {
        // In fields of them, not at the rim and not within the towers.
        const float wide = 1.0f / (0.5f * k.anvil_radius), per_m = 1.0f / (kMammaCell * k.height);
        const T patch = smooth_ramp<T>(
            0.75f + 1.5f * gradient_noise<T>(p.x * wide, p.y * wide, T{}, k.seed + 53u));
        hang = patch * smooth_ramp<T>((0.95f - rim) * 3.0f);
        deep = deep + k.mamma * hang * pouches<T>(p.x * per_m, p.y * per_m, k.seed + 54u);
        hang = hang * min_(k.mamma * (1.0f / (0.04f * k.height)), 1.0f);
    }
    const T over = p.z - k.anvil_top, under = (k.anvil_top - deep) - p.z;
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
    T hung = 0.6f * max_(1.0f - 0.8f * rim, T{});
    if (k.mamma > 0.0f) hung = hung * (1.0f - hang);
    act = act + ice * (select(over > under, all<T>(0.12f), hung) - act);
    return {ice, rim, select(over > under, T{}, hang)};
}

/// Density of ice: a quarter of the fullest water in the middle, an eighth of that at the rim.
template <class T>
PILEUS_FN T anvil_density(const CloudParams& k, T d, const AnvilShare<T>& share) {
    T narrow = all<T>(1.0f), full = all<T>(0.25f);
    if (k.mamma > 0.0f) {
        // Pouches are crisper, as the grid allows, and hold what sinks into them.
        const float most = max_(kAnvilEdge * k.height / k.crisp - 1.0f, 0.0f);
        narrow = narrow + min_(2.0f * share.hung, all<T>(most));
        full = full + 0.35f * share.hung;
    }
    const T edge = smooth_ramp<T>(0.5f - d * (1.0f / (kAnvilEdge * k.height)) * narrow);
    return edge * full * (1.0f - 0.88f * smooth_ramp<T>(share.rim));
}

}  // namespace PILEUS_ISA
}  // namespace pileus
