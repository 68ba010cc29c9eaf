// SPDX-License-Identifier: Apache-2.0
// Lattice noises for procedural clouds: gradient noise and cellular (Worley) billows.
// in: lanes of coordinates in cell units, a seed -> out: the same bits at every width and machine.
// Perlin 2002, "Improving noise"; Worley 1996, "A cellular texture basis function".
#pragma once
#include "kernels_cpu/core/lanes.h"

namespace pileus {
inline namespace PILEUS_ISA {

constexpr std::uint32_t kHashX = 0x8da6b343u, kHashY = 0xd8163841u, kHashZ = 0xcb1ab31fu;

/// A lattice point's coordinates times odd constants, mod 2^32: wraps around at 2^32 cells.
template <class UU>
struct LatticePlace {
    UU x, y, z;
};
template <class II>
PILEUS_FN LatticePlace<U_of<II>> lattice_place(II x, II y, II z) {
    using UU = U_of<II>;
    return {reinterpret<UU>(x) * kHashX, reinterpret<UU>(y) * kHashY, reinterpret<UU>(z) * kHashZ};
}

/// 32 well mixed bits of the lattice point (cx, cy, cz) cells on from `p`.
template <class UU>
PILEUS_FN UU lattice_hash(const LatticePlace<UU>& p, int cx, int cy, int cz, std::uint32_t seed) {
    const UU x = p.x + std::uint32_t(cx) * kHashX, y = p.y + std::uint32_t(cy) * kHashY;
    const UU z = p.z + std::uint32_t(cz) * kHashZ;
    UU h = (x ^ y ^ z) + seed;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return h ^ (h >> 16);
}

/// Ten bits of a hash from bit `shift` on, as a number in (0, 1).
template <class UU>
PILEUS_FN F_of<UU> hash_share(UU h, int shift) {
    return (to_float(reinterpret<I_of<UU>>((h >> shift) & 1023u)) + 0.5f) * 0x1p-10f;
}

/// Quintic step that joins lattice cells with continuous curvature.
template <class T>
PILEUS_FN T fade(T t) {
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

/// The smooth step from 0 to 1, of t cut to [0, 1].
template <class T>
PILEUS_FN T smooth_ramp(T t) {
    const T s = max_(min_(t, all<T>(1.0f)), T{});
    return s * s * (3.0f - 2.0f * s);
}

/// Dot product of a corner's random gradient (each component in (-1, 1)) with the offset to it.
template <class T>
PILEUS_FN T corner_slope(U_of<T> h, T x, T y, T z) {
    const T gx = hash_share(h, 0) * 2.0f - 1.0f;
    const T gy = hash_share(h, 10) * 2.0f - 1.0f;
    const T gz = hash_share(h, 20) * 2.0f - 1.0f;
    return gx * x + gy * y + gz * z;
}

/// Gradient noise at a share of a cell whose corners are hashed by hash(x, y, z), each 0 or 1.
template <class T, class Hash>
PILEUS_FN T blend_slopes(T fx, T fy, T fz, Hash hash) {
    const T u = fade(fx), v = fade(fy), w = fade(fz);
    T sum{};
    for (int c = 0; c < 8; ++c) {
        const int cx = c & 1, cy = (c >> 1) & 1, cz = c >> 2;
        const auto h = hash(cx, cy, cz);
        const T slope = corner_slope<T>(h, fx - float(cx), fy - float(cy), fz - float(cz));
        const T share = (cx ? u : 1.0f - u) * (cy ? v : 1.0f - v) * (cz ? w : 1.0f - w);
        sum = sum + share * slope;
    }
    return sum;
}

/// Gradient noise, mean 0, typically within 0.5; |value| < 1.5, as the weighted offsets to the
/// corners sum to at most 1/2 per axis. |x|, |y|, |z| < 2^22.
template <class T>
PILEUS_FN T gradient_noise(T x, T y, T z, std::uint32_t seed) {
    const auto ix = floor_int(x), iy = floor_int(y), iz = floor_int(z);
    const auto place = lattice_place(ix, iy, iz);
    return blend_slopes(
        x - to_float(ix), y - to_float(iy), z - to_float(iz),
        [&](int cx, int cy, int cz) { return lattice_hash(place, cx, cy, cz, seed); });
}

/// The 27 cells around a place, the nearest first: its own, then across faces, edges, corners.
PILEUS_NUMBERS int kAround[27] = {13, 4,  10, 12, 14, 16, 22, 1, 3, 5,  7,  9,  11, 15,
                                  17, 19, 21, 23, 25, 0,  2,  6, 8, 18, 20, 24, 26};

/// Squared distance to the nearest of the points strewn one per cell, in [0, 3].
/// Exact over the 27 cells around. |x|, |y|, |z| < 2^22.
template <class T>
PILEUS_FN T worley_squared(T x, T y, T z, std::uint32_t seed) {
    const auto ix = floor_int(x), iy = floor_int(y), iz = floor_int(z);
    const T fx = x - to_float(ix), fy = y - to_float(iy), fz = z - to_float(iz);
    const auto place = lattice_place(ix, iy, iz);
    T nearest = all<T>(3.0f);
    // Squared distance to each neighbour along an axis: what none of its points can beat, by
    // rounding either, since rounding keeps order.
    const T ax[3] = {fx * fx, T{}, (1.0f - fx) * (1.0f - fx)};
    const T ay[3] = {fy * fy, T{}, (1.0f - fy) * (1.0f - fy)};
    const T az[3] = {fz * fz, T{}, (1.0f - fz) * (1.0f - fz)};
    for (int c : kAround) {
        const int cx = c % 3 - 1, cy = c / 3 % 3 - 1, cz = c / 9 - 1;
        if (!any(ax[cx + 1] + ay[cy + 1] + az[cz + 1] < nearest)) continue;
        const auto h = lattice_hash(place, cx, cy, cz, seed);
        const T dx = hash_share(h, 0) + float(cx) - fx;
        const T dy = hash_share(h, 10) + float(cy) - fy;
        const T dz = hash_share(h, 20) + float(cz) - fz;
        nearest = min_(nearest, dx * dx + dy * dy + dz * dz);
    }
    return nearest;
}

/// Inverted Worley noise: round humps (1) that meet in creases (0), mean about 0.7.
template <class T>
PILEUS_FN T billow(T x, T y, T z, std::uint32_t seed) {
    return max_(1.0f - worley_squared(x, y, z, seed), all<T>(0.0f));
}

}  // namespace PILEUS_ISA
}  // namespace pileus
