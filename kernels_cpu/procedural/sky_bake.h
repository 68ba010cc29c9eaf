// SPDX-License-Identifier: Apache-2.0
// A procedural sky on a grid, and the largest noise of columns, from which thresholds follow.
// in: BakeParams, ColumnParams -> out: densities per cell; numbers per column.
// docs/skies.md, "Coverage" and "Baked to a grid".
#pragma once
#include "kernels_cpu/procedural/noise.h"
#include "kernels_cpu/procedural/sky_field.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Rows [begin, end) of cells, a row along x; values at the middles of cells.
template <int W>
PILEUS_FN void bake_sky_rows(const BakeParams& k, const BakeBuffers& b, std::uint32_t begin,
                             std::uint32_t end) {
    using T = F<W>;
    const std::uint32_t rows = std::uint32_t(k.size[1]);
    for (std::uint32_t row = begin; row < end; ++row) {
        const float y = (float(row % rows) + 0.5f) * k.cell_m[1];
        const float z = (float(row / rows) + 0.5f) * k.cell_m[2];
        for (std::int32_t x = 0; x < k.size[0]; x += W) {
            const T px = (to_float(iota<I<W>>() + x) + 0.5f) * k.cell_m[0];
            const Vec<T> p{px, all<T>(y), all<T>(z)};
            const T value = sky_density(k.sky, p, all<T>(k.width_m));
            float* to = b.density + std::size_t(row) * std::size_t(k.size[0]) + std::size_t(x);
            for (int l = 0; l < W && x + l < k.size[0]; ++l) to[l] = lane(value, l);
        }
    }
}

/// Columns [begin, end), strewn by a hash of their numbers; b.most holds a multiple of 16.
template <int W>
PILEUS_FN void sky_columns(const ColumnParams& k, const ColumnBuffers& b, std::uint32_t begin,
                           std::uint32_t end) {
    using T = F<W>;
    using UU = U<W>;
    for (std::uint32_t c = begin; c < end; c += W) {
        const UU number = reinterpret<UU>(iota<I<W>>() + std::int32_t(c));
        const LatticePlace<UU> place{number * kHashX, number * kHashY, number * kHashZ};
        const auto share = [&](std::uint32_t seed) {
            const UU h = lattice_hash(place, 0, 0, 0, seed);
            return to_float(reinterpret<I<W>>(h >> 8)) * 0x1p-24f;
        };
        const T x = share(1) * k.reach_m, y = share(2) * k.reach_m;
        // A flat layer holds one slice of the noise; a bent one holds all of it somewhere.
        T base = all<T>(k.sky.low_m - k.sky.shift_m[2]);
        if (k.sky.curvature_per_m > 0.0f) base = base + share(3) * k.reach_m;
        T largest = all<T>(-1e30f);
        for (std::int32_t i = 0; i < k.heights; ++i) {
            const float up = (float(i) + 0.5f) / float(k.heights);
            const Vec<T> p{x, y, base + up * k.sky.height_m};
            const T value = sky_noise(k.sky, p, T{}).value - sky_lift(k.sky, all<T>(up));
            largest = max_(largest, value);
        }
        for (int l = 0; l < W; ++l) b.most[c + std::uint32_t(l)] = lane(largest, l);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
