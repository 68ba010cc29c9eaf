// SPDX-License-Identifier: Apache-2.0
// Noise volumes kept on disk between runs, under a digest of everything that shapes them.
// in: NoiseParams, a folder -> out: bytes, read back or made anew; a damaged file is never used.
// docs/skies.md, "The cache"; docs/formats.md, "Noise volumes".
#pragma once
#include <string>

#include "src/world/density/noise_volume.h"

namespace pileus {

/// $PILEUS_CACHE_DIR, else $XDG_CACHE_HOME/pileus, else $HOME/.cache/pileus; empty: none.
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
