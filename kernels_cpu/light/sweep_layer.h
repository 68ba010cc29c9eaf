// SPDX-License-Identifier: Apache-2.0
// The sweep of a periodic medium, whose slices lie one above the other.
// in: densities, the neighbours that a node's ray to the next slice runs over -> out: optical
// depth. docs/buffer.md. A low sun's ray runs over many voxels between two slices: one tap for
// each.
#pragma once
#include "kernels_cpu/light/sweep.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// out[i] += weight * from[i + shift] for i in [begin, end).
template <int W>
PILEUS_FN void add_tap(float* out, const float* from, std::int32_t shift, float weight,
                       std::int32_t begin, std::int32_t end) {
    std::int32_t i = begin;
    for (; i + W <= end; i += W) {
        const F<W> sum = load_sweep<F<W>>(out + i) + load_sweep<F<W>>(from + (i + shift)) * weight;
        __builtin_memcpy(out + i, &sum, sizeof sum);
    }
    for (; i < end; ++i) out[i] = out[i] + from[i + shift] * weight;
}

/// Rows [begin, end) of the slice.
template <int W>
PILEUS_FN void sweep_layer_rows(const SweepLayerParams& k, const SweepBuffers& b,
                                std::uint32_t begin, std::uint32_t end) {
    const std::int32_t nx = k.size[0], ny = k.size[1];
    const std::int64_t slice = std::int64_t(nx) * ny;
    for (std::int32_t y = std::int32_t(begin); y < std::int32_t(end); ++y) {
        float* out = b.optical_depth + k.plane * slice + std::int64_t(y) * nx;
        for (std::int32_t x = 0; x < nx; ++x) out[x] = 0.0f;
        for (std::int32_t t = 0; t < k.taps; ++t) {
            const SweepTap& tap = b.taps[t];
            const std::int32_t row = y + tap.dy < ny ? y + tap.dy : y + tap.dy - ny;
            const float* grid = tap.from == 0 ? b.optical_depth : b.density;
            const float* from =
                grid + (tap.from == 2 ? k.plane : k.above) * slice + std::int64_t(row) * nx;
            add_tap<W>(out, from, tap.dx, tap.weight, 0, nx - tap.dx);
            add_tap<W>(out, from, tap.dx - nx, tap.weight, nx - tap.dx, nx);
        }
        for (std::int32_t x = 0; x < nx; ++x) out[x] = min_(out[x], kMaxOpticalDepth);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
