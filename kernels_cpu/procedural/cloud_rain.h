// SPDX-License-Identifier: Apache-2.0
// Rain below a cloud: shafts or patches at the base, drawn out into streaks by the wind, that dry
// air takes away on their way down.
// in: a grid, where it rains -> out: densities in [0, 1], the same bits at every width.
// docs/generators.md, "Rain"; Marshall and Palmer 1948; Kessler 1969.
#pragma once
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/procedural/periodic_noise.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Share of the strength at the place of the base that rain comes from, 0 to 1, before streaks.
template <class T>
PILEUS_FN T rain_patches(const CloudRainParams& k, T x, T y, T wide) {
    if (k.count == 0) return smooth_ramp<T>(0.55f + 1.6f * wide);
    T inside = all<T>(-1e9f);
    for (std::int32_t i = 0; i < k.count; ++i) {
        const RainShaft& s = k.shafts[i];
        const T dx = x - s.x, dy = y - s.y;
        inside = max_(inside, 1.0f - sqrt_(dx * dx + dy * dy) * (1.0f / s.r));
    }
    return smooth_ramp<T>(1.8f * inside + 1.1f * wide);
}

/// Density of rain at height z over the base.
template <class T>
PILEUS_FN T rain_density(const CloudRainParams& k, T px, T py, float z) {
    const float fallen = max_(-z, 0.0f);
    // Drops that fell longer trail farther behind the wind.
    const float trail = fallen * (0.4f + 0.6f * fallen / k.depth);
    const T x = px + k.lean_x * trail, y = py + k.lean_y * trail;
    T noise[3];
    for (std::uint32_t o = 0; o < 3; ++o)
        noise[o] =
            periodic_noise<T>(x * k.per_x[o], y * k.per_y[o], all<T>((z + k.fallen) * k.per_z[o]),
                              {k.period_x[o], k.period_y[o]}, k.seed + 120u + o);
    // Turrets stand where the outline of the heap is bent to.
    T bx = x, by = y;
    if (k.plan > 0.0f) {
        float scale = k.plan_per_m, reach = k.plan;
        for (std::uint32_t o = 0; o < 2; ++o) {
            const std::uint32_t s = k.plan_seed + 32u + o * 2u;
            bx = bx + reach * gradient_noise<T>(x * scale, y * scale, T{}, s);
            by = by + reach * gradient_noise<T>(x * scale, y * scale, T{}, s + 1u);
            scale *= 2.0f, reach *= 0.45f;
        }
    }
    const T streaks = max_(0.8f + 0.7f * noise[1] + 0.9f * noise[2], all<T>(0.1f));
    const T b = k.strength * rain_patches(k, bx, by, noise[0]) * min_(streaks, all<T>(1.3f)) -
                k.lost_per_m * fallen;
    const T left = max_(b, T{});
    const float fade = 1.0f - smooth_ramp<float>(z / k.top);
    return min_(left * left * (k.full * fade), all<T>(1.0f));
}

/// Fills rows of cells along x, [begin, end) of size[1] layers. Of what is there and what is made
/// the larger stays.
template <int W>
PILEUS_FN void fill_cloud_rain(const CloudRainParams& k, const CloudRainBuffers& b,
                               std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    const std::int32_t nx = k.size[0], ny = k.size[1];
    const bool sides = k.count > 0;  // of a layer none
    for (std::int32_t row = std::int32_t(begin); row < std::int32_t(end); ++row) {
        const std::int32_t iy = row % ny, iz = row / ny;
        if (sides && (iy == 0 || iy + 1 == ny)) continue;
        const T y = all<T>(k.corner[1] + float(iy) * k.cell[1]);
        const float z = k.corner[2] + float(iz) * k.cell[2];
        for (std::int32_t x0 = 0; x0 < nx; x0 += W) {
            const T x = k.corner[0] + to_float(iota<I<W>>() + x0) * k.cell[0];
            const T value = rain_density<T>(k, x, y, z);
            const std::int32_t count = min_(nx - x0, std::int32_t(W));
            for (std::int32_t l = 0; l < count; ++l) {
                if (sides && (x0 + l == 0 || x0 + l + 1 == nx)) continue;
                float& cell = b.density[std::int64_t(row) * nx + x0 + l];
                cell = max_(cell, float(lane(value, l)));
            }
        }
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
