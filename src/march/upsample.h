// SPDX-License-Identifier: Apache-2.0
// Pictures of which few pixels are marched: the others from their neighbours, or the frame before.
// in: a raymarch, its camera, what the frame before left -> out: planes of the whole picture.
// docs/upsampling.md
#pragma once
#include "src/march/march.h"

namespace pileus {

/// What one frame leaves to the next, and scratch.
struct UpsampleMemory {
    Planes few;                                         ///< marched pixels
    Buffer<float> transmittance, colour, opaque_depth;  ///< of the frame before
    CameraParams camera{};
    std::array<float, 3> to_sun{};
    bool ready = false;
    std::uint64_t marched = 0, recalled = 0;  ///< pixels, of all frames so far
};

/// Marched pixels of a frame: all where nothing is thinned out, or nothing is known yet.
PixelLattice upsample_lattice(const RaymarchSettings& settings, const CameraParams& camera,
                              int frame, bool remembers);

/// As raymarch_picture, by the upsampling and reprojection that the settings ask for; `frame` of
/// the animation decides which pixels are marched. kLimit: out of memory.
Status upsample_picture(const Context& context, const RaymarchInput& in, int frame,
                        UpsampleMemory& memory, Planes& planes, RaymarchTally& tally);

/// UpsampleMemory and the counts beside it; `last` uses them last.
void add_upsample_row(const RaymarchSettings& settings, const std::array<int, 2>& resolution,
                      bool solid, bool half_depth, bool optical_depth, Stage last,
                      MemoryTable& table);

}  // namespace pileus
