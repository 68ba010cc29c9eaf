// SPDX-License-Identifier: Apache-2.0
// The least that blending can cost: its loads, stores, multiplications, additions and roots.
// in: a number of blended pixels and of floats of the picture -> out: a checksum.
// Read with README.md: a picture's time over this says what order, spans and idle lanes cost.
#pragma once
#include <cstdint>

#include "kernels_cpu/isa/kernels.h"

namespace bench {

constexpr std::uint64_t kFloorTile = 256 * 32;  ///< pixels of a tile
constexpr std::uint64_t kFloorPlanes = 5;       ///< transmittance, 1/|ray| and three colours

struct BlendFloorWork {
    std::uint64_t pixels;  ///< to blend
    std::uint64_t
        frame;  ///< floats to write to `image`; planes of a tile are read, again and again
    float *tile, *image;  ///< kFloorPlanes planes of kFloorTile; `frame` floats
};

using BlendFloor = float (*)(const BlendFloorWork&);

/// The floor compiled for the instruction set of that name; null where there is none.
BlendFloor blend_floor(const char* isa);

}  // namespace bench
