// SPDX-License-Identifier: Apache-2.0
// A noise volume as the kernels read it: packed words in levels of halved size, and block maxima.
// in: bytes of a volume -> out: NoiseView with its arrays.
// docs/skies.md, "Reading", "Level of detail".
#pragma once
#include "src/world/density/noise_volume.h"

namespace pileus {

struct NoiseTexture {
    Buffer<std::int32_t> words, largest;
    int size = 0;
    int most = 0;  ///< the largest byte
    /// Variance that reading a level gives less than reading level 0, in units of a byte's step.
    double lost[kMostNoiseLevels] = {};

    /// The arrays and sizes; place, scale and share are the caller's.
    NoiseView view() const;
};

/// kLimit: out of memory.
Status pack_noise(const Buffer<std::uint8_t>& texels, int size, int threads, NoiseTexture& out);

/// Bytes of a texture, and of what is beside it while it is packed.
std::uint64_t noise_texture_bytes(std::uint64_t size);
std::uint64_t noise_packing_bytes(std::uint64_t size);

}  // namespace pileus
