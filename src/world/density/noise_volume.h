// SPDX-License-Identifier: Apache-2.0
// A noise volume: one byte per texel, without a seam at its ends, the same bytes everywhere.
// in: NoiseParams -> out: bytes whose mean is near 127.5 and whose deviation is near 255/7.
// docs/skies.md, "The two volumes".
#pragma once
#include <string>

#include "kernels_cpu/isa/kernels.h"
#include "src/base/buffer.h"

namespace pileus {

constexpr int kMinNoiseSize = 16, kMaxNoiseSize = 512;

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

// A noise volume as the kernels read it: packed words in levels of halved size, and block maxima.
// docs/skies.md, "Reading", "Level of detail".

struct NoiseTexture {
    Buffer<std::int32_t> words, largest;
    int size = 0;
    int most = 0;  ///< the largest byte
    /// Variance that reading a level gives less than reading level 0, in units of a byte's step.
    double lost[kMaxNoiseLevels] = {};

    /// The arrays and sizes; place, scale and share are the caller's.
    NoiseView view() const;
};

/// kLimit: out of memory.
Status pack_noise(const Buffer<std::uint8_t>& texels, int size, int threads, NoiseTexture& out);

/// Bytes of a texture, and of what is beside it while it is packed.
std::uint64_t noise_texture_bytes(std::uint64_t size);
std::uint64_t noise_packing_bytes(std::uint64_t size);

// Noise volumes kept on disk between runs, under a digest of everything that shapes them.
// docs/skies.md, "The cache"; docs/formats.md, "Noise volumes".

/// $PILEUS_CACHE_DIR, else $XDG_CACHE_HOME/pileus, else $HOME/.cache/pileus, else (Windows)
/// %LOCALAPPDATA%/pileus; empty: none.
std::string cache_folder();

/// File name of a volume: its kind, size and 16 hex digits of its parameters and their version.
std::string noise_file_name(const NoiseParams& params);

enum class NoiseOrigin { kRead, kMade, kMadeUnkept };

/// Reads the volume from `folder`, or makes it and tries to keep it there; an empty folder keeps
/// none. A file that is cut short, altered or another's is replaced. No fault of the disk is an
/// error. kLimit: out of memory.
Status load_noise(const NoiseParams& params, const std::string& folder, const KernelTable& kernels,
                  int threads, Buffer<std::uint8_t>& texels, NoiseOrigin& origin);

}  // namespace pileus
