// SPDX-License-Identifier: Apache-2.0
// Layers of cloud that repeat with their box: cells of rising air, sheets, streaks of falling ice.
// in: a grid, a layer -> out: a map of rising air, densities in [0, 1], the same bits at every
// width. docs/generators.md, "Layers"; Wood 2012, "Stratocumulus clouds"; Heymsfield 1975.
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/procedural/cloud_heap.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// A lattice whose cells are about `length` long and fit the box a whole number of times.
struct LayerLattice {
    LatticePeriods periods;
    float per_x, per_y;
};
PILEUS_FN LayerLattice layer_lattice(const CloudLayerParams& k, float length, float stretch_y) {
    LayerLattice out;
    out.periods.x = max_(std::int32_t(k.width[0] / length + 0.5f), 1);
    out.periods.y = max_(std::int32_t(k.width[1] / (length * stretch_y) + 0.5f), 1);
    out.per_x = float(out.periods.x) / k.width[0], out.per_y = float(out.periods.y) / k.width[1];
    return out;
}
template <class T>
PILEUS_FN T layer_noise(const LayerLattice& l, T x, T y, T z, std::uint32_t seed) {
    return periodic_noise<T>(x * l.per_x, y * l.per_y, z, l.periods, seed);
}

/// Sum of octaves, the first of `length`, each half as long and `gain` as strong.
template <class T>
PILEUS_FN T layer_octaves(const CloudLayerParams& k, T x, T y, T z, float length, float stretch_y,
                          int count, float gain, std::uint32_t seed) {
    T sum{};
    float weight = 1.0f;
    for (int o = 0; o < count; ++o, length *= 0.5f, weight *= gain) {
        const LayerLattice l = layer_lattice(k, length, stretch_y);
        sum = sum + weight * layer_noise<T>(l, x, y, z, seed + std::uint32_t(o) * 7u);
        z = z * 2.0f;
    }
    return sum;
}

/// Rising air in [0, 1] above a place of the plane.
template <class T>
PILEUS_FN T rising_air(const CloudLayerParams& k, T x, T y) {
    const T zero{}, one = all<T>(1.0f);
    const float wide = 3.2f * k.length;
    const T slow = layer_octaves<T>(k, x, y, zero, wide, 1.0f, 2, 0.5f, k.seed + 50u);
    if (k.form == kLayerSheet) {
        // A gain of 2^(-1/3) makes a spectrum of -5/3, as eddies do.
        int count = 1;
        for (float size = 0.5f * k.length; size > 2.0f * k.cell[0] && count < 8; size *= 0.5f)
            ++count;
        return 0.5f + 0.5f * slow +
               0.4f * layer_octaves<T>(k, x, y, zero, k.length, 1.0f, count, 0.79f, k.seed + 60u);
    }
    if (k.form == kLayerStreaks)
        return 0.5f +
               0.7f * layer_octaves<T>(k, x, y, zero, k.length * 4.0f, 0.4f, 3, 0.5f, k.seed + 60u);
    // Cells are bent, so that walls are no straight lines.
    T bx = x, by = y;
    float length = 0.64f * k.length, reach = 0.26f * k.length;
    for (std::uint32_t o = 0; o < 3; ++o, length *= 0.5f, reach *= 0.5f) {
        const LayerLattice l = layer_lattice(k, length, 1.0f);
        bx = bx + reach * layer_noise<T>(l, x, y, zero, k.seed + 70u + o * 2u);
        by = by + reach * layer_noise<T>(l, x, y, zero, k.seed + 71u + o * 2u);
    }
    T sum{};
    const float weights[3] = {0.46f, 0.32f, 0.22f};
    float size = k.length;
    for (std::uint32_t o = 0; o < 3; ++o, size *= 0.33f) {
        const LayerLattice l = layer_lattice(k, size, 1.0f);
        const T wall = cell_walls<T>(bx * l.per_x, by * l.per_y, l.periods, k.seed + 80u + o);
        const T e = min_(wall * 1.6f, one);
        T part = e * (2.0f - e);
        if (k.form == kLayerOpen && o == 0) part = one - smooth_ramp<T>(wall * 1.5f);
        sum = sum + weights[o] * part;
    }
    return max_(min_(sum + 0.6f * slow, one), zero);
}

/// The larger of two distances, joined over a width.
template <class T>
PILEUS_FN T blend_max(T a, T b, float k) {
    const T h = max_(k - abs_(a - b), T{});
    return max_(a, b) + h * h * (0.25f / k);
}

/// Density of cells and sheets at height z over the base, where `m` is the rising air and (gx, gy)
/// its slope per metre.
template <class T>
PILEUS_FN T layer_density(const CloudLayerParams& k, T x, T y, T z, T m, T gx, T gy) {
    const float h = k.height;
    const T fine = layer_octaves<T>(k, x, y, z * (1.0f / h), 0.6f * h, 1.0f, 2, 0.5f, k.seed + 90u);
    const T top = h * (0.72f + 0.30f * m), over = z - top;
    // Where air sinks it is drier, and condenses higher.
    const T base = (0.5f * h) * (1.0f - smooth_ramp<T>(1.3f * (m - k.gap))) + (0.04f * h) * fine;
    const T below = k.grounded > 0.0f ? all<T>(-h) : base - z;
    const T side = ((k.form == kLayerSheet ? 2.0f : 0.67f) * h) * (k.gap - m);
    CloudSurface<T> s;
    s.distance = blend_max<T>(blend_max<T>(over, below, 0.18f * h), side, 0.18f * h);
    const auto sided = (side > over) & (side > below);
    const T slope = sqrt_(gx * gx + gy * gy) + 1e-12f;
    s.normal.x = select(sided, T{} - gx / slope, T{});
    s.normal.y = select(sided, T{} - gy / slope, T{});
    s.normal.z = select(sided, T{}, select(over > below, all<T>(1.0f), all<T>(-1.0f)));
    const T macro = s.distance;
    T act = all<T>(k.act) * (0.5f + 0.5f * smooth_ramp<T>(z * (2.0f / h)));
    float size = k.lump;
    for (int o = 0; o < k.octaves; ++o, size *= 0.5f) {
        const float out = 2.0f * size * kLumpReach + k.edge;
        const float in = 2.0f * size * k.erosion + k.edge;
        if (!any((s.distance < out) & (s.distance > -in))) break;
        // The lattice fits the box along x and y: its cells are not quite cubes there.
        const LayerLattice l = layer_lattice(k, size, 1.0f);
        s.at = {x * (l.per_x * size), y * (l.per_y * size), z * (1 / 1.3f)};
        add_lumps(s, size, act, k.erosion, 0.0f, k.seed + std::uint32_t(o) * 0x632be5abu,
                  l.periods);
        act = act * 0.9f;
    }
    const T edge = smooth_ramp<T>(0.5f - s.distance * (1.0f / k.edge));
    const T inner = smooth_ramp<T>(macro * (-4.0f / h));
    const T water = k.per_full > 0.0f
                        ? two_thirds_power<T>(min_(max_(z * k.per_full, T{}), all<T>(1.0f)))
                        : all<T>(1.0f);
    return edge * water * (1.0f - 0.25f * max_(1.0f - m, T{})) * (0.75f + 0.25f * inner);
}

/// Density of ice that falls from heads at the layer's top: a place is carried back along its way.
template <class T>
PILEUS_FN T streak_density(const CloudLayerParams& k, T x, T y, T z) {
    const float h = k.height;
    const T fallen = h - z, share = fallen * (1.0f / h);
    const T back = k.shear * fallen * (0.12f + 0.5f * share);
    T from = x + back;
    if (k.turn != 0.0f) {
        // The wind below blows along another way.
        const auto half =
            sincos_turns((k.turn * max_(min_(share, all<T>(1.0f)), T{}) + 1.0f) * 0.5f);
        from = x + back * (half.cosine * half.cosine - half.sine * half.sine);
        y = y + back * (2.0f * half.cosine * half.sine);
    }
    const T bands = rising_air<T>(k, from, y);
    int count = 1;
    for (float size = k.length * 0.15f; size > 1.5f * k.cell[1] && count < 7; size *= 0.5f) ++count;
    const T fine =
        layer_octaves<T>(k, from, y, share * 0.4f, k.length, 0.35f, count, 0.62f, k.seed + 95u);
    const T v = max_(bands - k.gap - 0.45f * share * share + 0.75f * fine, T{});
    const T head = 0.35f + 0.65f * (1.0f - smooth_ramp<T>(share * 3.0f));
    const T ends = smooth_ramp<T>(share * 12.0f) * smooth_ramp<T>((1.0f - share) * 5.0f);
    return min_(v * v * head * ends * 2.0f, all<T>(1.0f));
}

/// Fills rows of columns along x, [begin, end) of size[1], of the map or of the densities. The
/// lowest and the highest layer of cells stay empty.
template <int W>
PILEUS_FN void fill_cloud_layer(const CloudLayerParams& k, const CloudLayerBuffers& b,
                                std::uint32_t begin, std::uint32_t end) {
    using T = F<W>;
    const std::int32_t nx = k.size[0], ny = k.size[1];
    for (std::int32_t row = std::int32_t(begin); row < std::int32_t(end); ++row) {
        const T y = all<T>((float(row) + 0.5f) * k.cell[1]);
        const std::int64_t north = std::int64_t(row + 1 < ny ? row + 1 : 0) * nx,
                           south = std::int64_t(row > 0 ? row - 1 : ny - 1) * nx,
                           here = std::int64_t(row) * nx;
        for (std::int32_t x0 = 0; x0 < nx; x0 += W) {
            const std::int32_t count = min_(nx - x0, std::int32_t(W));
            const T x = (to_float(iota<I<W>>() + x0) + 0.5f) * k.cell[0];
            if (k.map != 0) {
                const T m = rising_air<T>(k, x, y);
                for (int l = 0; l < count; ++l) b.map[here + x0 + l] = lane(m, l);
                continue;
            }
            T m{}, gx{}, gy{};
            for (int l = 0; l < count; ++l) {
                const std::int32_t c = x0 + l, e = c + 1 < nx ? c + 1 : 0,
                                   w = c > 0 ? c - 1 : nx - 1;
                set_lane(m, l, b.map[here + c]);
                set_lane(gx, l, (b.map[here + e] - b.map[here + w]) / (2 * k.cell[0]));
                set_lane(gy, l, (b.map[north + c] - b.map[south + c]) / (2 * k.cell[1]));
            }
            for (std::int32_t z = 1; z + 1 < k.size[2]; ++z) {
                const T height = all<T>(k.lowest + float(z) * k.cell[2]);
                const T value = k.form == kLayerStreaks
                                    ? streak_density<T>(k, x, y, height)
                                    : layer_density<T>(k, x, y, height, m, gx, gy);
                for (int l = 0; l < count; ++l)
                    b.density[(std::int64_t(z) * ny + row) * nx + x0 + l] = lane(value, l);
            }
        }
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
