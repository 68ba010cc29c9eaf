// SPDX-License-Identifier: Apache-2.0
// The lattice noises of noise.h on a lattice that comes back to its start: tiles without a seam.
// in: lanes of coordinates in [0, cells) -> out: the same bits at every width and machine.
// Perlin 2002; Worley 1996; docs/skies.md, "The two volumes".
#pragma once
#include "kernels_cpu/procedural/noise.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// 32 well mixed bits of the lattice point whose products with the odd constants are these.
template <class UU>
PILEUS_FN UU mixed(UU x, UU y, UU z, std::uint32_t seed) {
    UU h = (x ^ y ^ z) + seed;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return h ^ (h >> 16);
}

/// A coordinate's cell and its neighbours on both sides, times an odd constant, and the rest.
template <class T>
struct TileAxis {
    U_of<T> at[3];  ///< below, own, above
    T rest;
};
template <class T>
PILEUS_FN TileAxis<T> tile_axis(T v, std::int32_t cells, std::uint32_t odd) {
    using II = I_of<T>;
    using UU = U_of<T>;
    const II own = floor_int(v);
    const II below = select(own == 0, all<II>(cells - 1), own - 1);
    const II above = select(own == cells - 1, II{}, own + 1);
    return {
        {reinterpret<UU>(below) * odd, reinterpret<UU>(own) * odd, reinterpret<UU>(above) * odd},
        v - to_float(own)};
}

/// gradient_noise with a period of `cells` along each axis.
template <class T>
PILEUS_FN T tile_gradient(T x, T y, T z, std::int32_t cells, std::uint32_t seed) {
    const TileAxis<T> ax = tile_axis(x, cells, kHashX), ay = tile_axis(y, cells, kHashY);
    const TileAxis<T> az = tile_axis(z, cells, kHashZ);
    const T u = fade(ax.rest), v = fade(ay.rest), w = fade(az.rest);
    T sum{};
    for (int c = 0; c < 8; ++c) {
        const int cx = c & 1, cy = (c >> 1) & 1, cz = c >> 2;
        const auto h = mixed(ax.at[1 + cx], ay.at[1 + cy], az.at[1 + cz], seed);
        const T slope =
            corner_slope<T>(h, ax.rest - float(cx), ay.rest - float(cy), az.rest - float(cz));
        sum = sum + (cx ? u : 1.0f - u) * (cy ? v : 1.0f - v) * (cz ? w : 1.0f - w) * slope;
    }
    return sum;
}

/// billow with a period of `cells` along each axis.
template <class T>
PILEUS_FN T tile_billow(T x, T y, T z, std::int32_t cells, std::uint32_t seed) {
    const TileAxis<T> ax = tile_axis(x, cells, kHashX), ay = tile_axis(y, cells, kHashY);
    const TileAxis<T> az = tile_axis(z, cells, kHashZ);
    const auto gaps = [](T f, T(&gap)[3]) {
        gap[0] = f * f, gap[1] = T{}, gap[2] = (1.0f - f) * (1.0f - f);
    };
    T gx[3], gy[3], gz[3];
    gaps(ax.rest, gx), gaps(ay.rest, gy), gaps(az.rest, gz);
    T nearest = all<T>(1.0f);  // farther ones count as the crease
    for (int c : kAround) {
        const int cx = c % 3, cy = c / 3 % 3, cz = c / 9;
        if (!any(gx[cx] + gy[cy] + gz[cz] < nearest)) continue;
        const auto h = mixed(ax.at[cx], ay.at[cy], az.at[cz], seed);
        const T dx = hash_share(h, 0) + float(cx - 1) - ax.rest;
        const T dy = hash_share(h, 10) + float(cy - 1) - ay.rest;
        const T dz = hash_share(h, 20) + float(cz - 1) - az.rest;
        nearest = min_(nearest, dx * dx + dy * dy + dz * dz);
    }
    return 1.0f - nearest;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
