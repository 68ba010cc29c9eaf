// SPDX-License-Identifier: Apache-2.0
// Lenticularis: moist layers that a standing wave lifts over their condensation levels, as smooth
// lenses upon one another.
// in: a grid, plates -> out: densities in [0, 1], the same bits at every width.
// docs/generators.md, "Lenses"; Durran 1986, "Mountain waves"; WMO 2017, "lenticularis".
#pragma once
#include "kernels_cpu/procedural/cloud_heap.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Density of one plate at the place (along, across) of the wind, height z over the base.
template <class T>
PILEUS_FN T plate_density(const CloudLensParams& k, const CloudPlate& plate, T along, T across, T z,
                          T bend) {
    const T one = all<T>(1.0f);
    const T x = (along - plate.x) * (1.0f / plate.along);
    const T lee = select(x > 0.0f, x * (1.0f / k.lee), x),
            y = (across - plate.y) * (1.0f / plate.across);
    // 1 in the middle, 0 at the rim.
    const T inside = one - (lee * lee + y * y) * bend;
    const T up = z - plate.rim;
    const T d = max_(up - plate.over * inside, T{} - up - plate.under * inside);
    // Water by the lift over the condensation level, which is the underside.
    const T lift = (up + plate.under * inside) * (3.0f / (plate.over + plate.under));
    const T water = two_thirds_power<T>(max_(min_(lift, one), T{}));
    return smooth_ramp<T>(0.5f - d * (1.0f / k.edge)) * water;
}

/// Fills rows of cells along x, [begin, end) of size[1] size[2]. The outermost cells stay empty.
template <int W>
PILEUS_FN void fill_cloud_lens(const CloudLensParams& k, const CloudLensBuffers& b,
                               std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    const std::int32_t nx = k.size[0], ny = k.size[1];
    for (std::int32_t row = std::int32_t(begin); row < std::int32_t(end); ++row) {
        const std::int32_t iy = row % ny, iz = row / ny;
        if (iy == 0 || iy + 1 == ny || iz == 0 || iz + 1 == k.size[2]) continue;
        const T y = all<T>(k.corner[1] + float(iy) * k.cell[1]);
        const T z = all<T>(k.corner[2] + float(iz) * k.cell[2]);
        for (std::int32_t x0 = 0; x0 < nx; x0 += W) {
            const T x = k.corner[0] + to_float(iota<I<W>>() + x0) * k.cell[0];
            const T along = x * k.wind_x + y * k.wind_y, across = y * k.wind_x - x * k.wind_y;
            const float wide = k.per_outline;
            // Of squared distances; lenses stay within 1.42 of their radii.
            T bend = 1.0f +
                     k.outline * (gradient_noise<T>(x * wide, y * wide, z * wide, k.seed + 110u) +
                                  0.4f * gradient_noise<T>(x * (2.2f * wide), y * (2.2f * wide),
                                                           z * (2.2f * wide), k.seed + 111u)) +
                     k.striae * gradient_noise<T>(x * (0.3f * wide), y * (0.3f * wide),
                                                  z * k.per_stria, k.seed + 112u);
            bend = max_(bend, all<T>(0.5f));
            T value{};
            for (std::int32_t i = 0; i < k.count; ++i)
                value = max_(value, plate_density(k, k.plates[i], along, across, z, bend));
            const std::int32_t count = min_(nx - x0, std::int32_t(W));
            for (std::int32_t l = 0; l < count; ++l)
                if (x0 + l > 0 && x0 + l + 1 < nx)
                    b.density[std::int64_t(row) * nx + x0 + l] = lane(value, l);
        }
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
