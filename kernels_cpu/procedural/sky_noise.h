// SPDX-License-Identifier: Apache-2.0
// Fills rows of a noise volume: octaves of periodic noise, each twice as fine and `gain` as large.
// in: NoiseParams -> out: values at texel centres, the first octave's size 1.
// Palenik 2016, section 5.1 (the textures); docs/skies.md, "The two volumes".
#pragma once
#include "kernels_cpu/procedural/noise_tile.h"
#include "kernels_cpu/procedural/sky_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Rows [begin, end), a row along x; row number y + size * z. `size` is a multiple of 16.
template <int W>
PILEUS_FN void noise_rows(const NoiseParams& k, const NoiseBuffers& b, std::uint32_t begin,
                          std::uint32_t end) {
    using T = F<W>;
    const std::uint32_t size = std::uint32_t(k.size);
    for (std::uint32_t row = begin; row < end; ++row) {
        const float y = float(row % size) + 0.5f, z = float(row / size) + 0.5f;
        for (std::int32_t x = 0; x < k.size; x += W) {
            const T px = to_float(iota<I<W>>() + x) + 0.5f;
            T sum{};
            float amplitude = 1.0f;
            std::int32_t cells = k.cells;
            for (std::int32_t octave = 0; octave < k.octaves; ++octave, cells *= 2) {
                // Exact: the size is a power of two and the products are small.
                const float scale = float(cells) / float(k.size);
                const T u = px * scale, v = all<T>(y * scale), w = all<T>(z * scale);
                const std::uint32_t seed = k.seed + std::uint32_t(octave) * 0x9e3779b9u;
                const T one = k.kind == kNoisePerlin ? tile_gradient(u, v, w, cells, seed)
                                                     : tile_billow(u, v, w, cells, seed);
                sum = sum + one * amplitude;
                amplitude = amplitude * k.gain;
            }
            __builtin_memcpy(b.values + std::size_t(row) * size + std::size_t(x), &sum, sizeof sum);
        }
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
