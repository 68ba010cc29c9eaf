// SPDX-License-Identifier: Apache-2.0
// Lumps upon a surface: hashed balls whose centres lie about the surface of the octave before, so
// that the normal of a lump carries the next, smaller lumps: overhangs and creases come by
// themselves.
// in: lanes of places, distances to a surface and its normals -> out: both with one octave more.
// docs/generators.md, "Octaves"
#pragma once
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/procedural/periodic_noise.h"

namespace pileus {
inline namespace PILEUS_ISA {

// All in cells of the octave.
constexpr float kLumpJitter = 0.3f;                       // of a centre from its lattice point
constexpr float kLumpSmall = 0.48f, kLumpSpread = 0.22f;  // radii; with jitter 8 points suffice
constexpr float kLumpSunk = 0.20f;       // centres lie about so far under the surface
constexpr float kLumpAbove = 1 / 0.60f;  // 1 over how far over that one may lie
constexpr float kLumpBelow = 1 / 0.75f;  // and how far below
constexpr float kLumpJoin = 0.05f;
/// How far outwards an octave moves a surface at most: of (c - sunk) + radius (1 - (c/0.6)^2) the
/// maximum over c, 0.63, and what blending adds.
constexpr float kLumpReach = 0.70f;

/// Blends two distances over the width k; `per_4k` is 1/(4k). Exact where they differ by k.
template <class T>
PILEUS_FN T blend_min(T a, T b, T k, T per_4k) {
    const T h = max_(k - abs_(a - b), T{});
    return min_(a, b) - h * h * per_4k;
}

/// A surface near lanes of points.
template <class T>
struct CloudSurface {
    Vec<T> at;  ///< metres, turned with the octaves
    T distance;
    Vec<T> normal;
};

/// Adds lumps of cell `size` metres; `act` in [0, 1] scales them, `loss` is added to the distance
/// besides the erosion, in cells. The lattice repeats after `periods` of its cells.
template <class T>
PILEUS_FN void add_lumps(CloudSurface<T>& s, float size, T act, float erosion, float loss,
                         std::uint32_t seed, const LatticePeriods& periods = {0, 0}) {
    const float per_m = 1.0f / size;
    const T x = s.at.x * per_m - 0.5f, y = s.at.y * per_m - 0.5f, z = s.at.z * per_m - 0.5f;
    const auto ix = floor_int(x), iy = floor_int(y), iz = floor_int(z);
    const T fx = x - to_float(ix), fy = y - to_float(iy), fz = z - to_float(iz);
    const LatticeCorners<U_of<T>> place = lattice_corners(ix, iy, iz, periods);
    const T height = s.distance * per_m;
    const T join = all<T>(kLumpJoin), unjoin = all<T>(0.25f / kLumpJoin), one = all<T>(1.0f);
    T best = height + act * erosion + loss;
    const Vec<T> n = s.normal;
    for (int c = 0; c < 8; ++c) {
        const int cx = c & 1, cy = (c >> 1) & 1, cz = c >> 2;
        const auto h = corner_hash(place, cx, cy, cz, seed);
        constexpr float kWide = 2 * kLumpJitter;
        const T ex = hash_share(h, 0) * kWide + (float(cx) - kLumpJitter) - fx;
        const T ey = hash_share(h, 10) * kWide + (float(cy) - kLumpJitter) - fy;
        const T ez = hash_share(h, 20) * kWide + (float(cz) - kLumpJitter) - fz;
        // Where the centre lies over the surface, to first order.
        const T over = height + n.x * ex + n.y * ey + n.z * ez + kLumpSunk;
        const T share = over * select(over > 0.0f, all<T>(kLumpAbove), all<T>(kLumpBelow));
        const T window = one - share * share;
        const auto counts = window > 0.0f;
        if (!any(counts)) continue;
        const T u = hash_share(h * 0x9e3779b9u, 20);
        const T far = sqrt_(ex * ex + ey * ey + ez * ez);
        const T own = far - (u * kLumpSpread + kLumpSmall) * window * act;
        const T a = select(counts, own, all<T>(1e9f));
        const auto nearer = a < best;
        const T inverse = -1.0f / max_(far, all<T>(1e-6f));
        s.normal.x = select(nearer, ex * inverse, s.normal.x);
        s.normal.y = select(nearer, ey * inverse, s.normal.y);
        s.normal.z = select(nearer, ez * inverse, s.normal.z);
        best = blend_min(best, a, join, unjoin);
    }
    s.distance = best * size;
}

/// Turns a vector by the angle of 3-4-5 about z, then by that of 5-12-13 about x, so that the
/// lattices of octaves do not line up.
template <class T>
PILEUS_FN Vec<T> turn_octave(const Vec<T>& v) {
    const T x = v.x * 0.8f - v.y * 0.6f, y = v.x * 0.6f + v.y * 0.8f;
    constexpr float kCos = 12.0f / 13.0f, kSin = 5.0f / 13.0f;
    return {x, y * kCos - v.z * kSin, y * kSin + v.z * kCos};
}

/// Octaves of halving cells, from number `first` of `count` on; each a tenth calmer than the one
/// before. Lanes beyond all reach keep a distance beyond it.
template <class T>
PILEUS_FN void add_octaves(CloudSurface<T>& s, float size, int count, T act, float erosion,
                           float loss, float width, std::uint32_t seed) {
    for (int k = 0; k < count; ++k, size *= 0.5f) {
        // What this octave and all finer ones can change at most; both beyond what counts.
        const float out = 2.0f * size * kLumpReach + width;
        const float in = 2.0f * size * (erosion + loss) + width;
        if (!any((s.distance < out) & (s.distance > -in))) return;
        add_lumps(s, size, act, erosion, loss, seed + std::uint32_t(k) * 0x632be5abu);
        act = act * 0.9f;
        s.at = turn_octave(s.at), s.normal = turn_octave(s.normal);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
