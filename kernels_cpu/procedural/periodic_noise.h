// SPDX-License-Identifier: Apache-2.0
// Lattice noises that repeat after whole numbers of cells along x and y, for media without sides.
// in: lanes of coordinates in cell units, periods, a seed -> out: the same bits at every width.
// Perlin 2002, "Improving noise"; Worley 1996, "A cellular texture basis function".
#pragma once
#include "kernels_cpu/procedural/noise.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Cells after which a lattice repeats; 0: never.
struct LatticePeriods {
    std::int32_t x, y;
};

/// i - period * floor(i / period), exact for |i| < 2^24.
template <class II>
PILEUS_FN II wrapped(II i, std::int32_t period) {
    if (period == 0) return i;
    return i - floor_int(to_float(i) / float(period)) * period;
}

/// Coordinates times odd constants of the two lattice points around a place along each axis.
template <class UU>
struct LatticeCorners {
    UU x[2], y[2], z[2];
};
template <class II>
PILEUS_FN LatticeCorners<U_of<II>> lattice_corners(II x, II y, II z, const LatticePeriods& p) {
    using UU = U_of<II>;
    LatticeCorners<UU> out;
    for (int i = 0; i < 2; ++i) {
        out.x[i] = reinterpret<UU>(wrapped<II>(x + i, p.x)) * kHashX;
        out.y[i] = reinterpret<UU>(wrapped<II>(y + i, p.y)) * kHashY;
        out.z[i] = reinterpret<UU>(z + i) * kHashZ;
    }
    return out;
}
template <class UU>
PILEUS_FN UU corner_hash(const LatticeCorners<UU>& c, int x, int y, int z, std::uint32_t seed) {
    return lattice_hash<UU>({c.x[x], c.y[y], c.z[z]}, 0, 0, 0, seed);
}

/// As gradient_noise.
template <class T>
PILEUS_FN T periodic_noise(T x, T y, T z, const LatticePeriods& periods, std::uint32_t seed) {
    const auto ix = floor_int(x), iy = floor_int(y), iz = floor_int(z);
    const LatticeCorners<U_of<T>> place = lattice_corners(ix, iy, iz, periods);
    return blend_slopes(
        x - to_float(ix), y - to_float(iy), z - to_float(iz),
        [&](int cx, int cy, int cz) { return corner_hash(place, cx, cy, cz, seed); });
}

/// Distance to the second nearest less that to the nearest of points strewn one per cell in a
/// plane: 0 along the walls between cells.
template <class T>
PILEUS_FN T cell_walls(T x, T y, const LatticePeriods& periods, std::uint32_t seed) {
    const auto ix = floor_int(x), iy = floor_int(y);
    const T fx = x - to_float(ix), fy = y - to_float(iy);
    using UU = U_of<T>;
    T first = all<T>(9.0f), second = first;
    for (int cy = -1; cy <= 1; ++cy)
        for (int cx = -1; cx <= 1; ++cx) {
            const auto wx = wrapped(ix + cx, periods.x);
            const auto wy = wrapped(iy + cy, periods.y);
            const UU h = lattice_hash<UU>(
                {reinterpret<UU>(wx) * kHashX, reinterpret<UU>(wy) * kHashY, UU{}}, 0, 0, 0, seed);
            const T dx = hash_share(h, 0) + float(cx) - fx;
            const T dy = hash_share(h, 10) + float(cy) - fy;
            const T square = dx * dx + dy * dy;
            second = min_(second, max_(first, square));
            first = min_(first, square);
        }
    return sqrt_(second) - sqrt_(first);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
