// SPDX-License-Identifier: Apache-2.0
// A noise volume: one byte per texel, without a seam at its ends, the same bytes everywhere.
// in: NoiseParams -> out: bytes whose mean is near 127.5 and whose deviation is near 255/7.
// docs/skies.md, "The two volumes".
#pragma once
#include "kernels_cpu/isa/kernels.h"
#include "src/base/buffer.h"

namespace pileus {

constexpr int kLeastNoiseSize = 16, kMostNoiseSize = 512;

/// Texels over the finest lattice cell that an octave may have.
constexpr int kTexelsPerCell = 4;

/// Octaves until the finest lattice has kTexelsPerCell texels per cell; at least 1.
int most_octaves(int size, int cells);

/// Makes the volume. `params` must hold a power of two within the sizes above, and lattices of at
/// most half as many cells as texels. kLimit: out of memory.
Status make_noise(const NoiseParams& params, const KernelTable& kernels, int threads,
                  Buffer<std::uint8_t>& texels);

/// Bytes while it is made, and afterwards.
constexpr std::uint64_t noise_making_bytes(std::uint64_t size) { return 5 * size * size * size; }

}  // namespace pileus
