// SPDX-License-Identifier: Apache-2.0
// Pictures of which few pixels are marched: the others from their neighbours, or the frame before.
// in: a march, its camera, what the frame before left -> out: planes of the whole picture.
// docs/upsampling.md
#pragma once
#include <functional>

#include "kernels_cpu/display/upsample_params.h"
#include "src/picture/layers.h"
#include "src/plan/frame_work.h"
#include "src/plan/plan.h"
#include "src/run/context.h"

namespace pileus {

/// What one frame leaves to the next, and scratch.
struct UpsampleMemory {
    Planes few;                                         ///< marched pixels
    Buffer<float> transmittance, colour, opaque_depth;  ///< of the frame before
    CameraParams camera{};
    std::array<float, 3> to_sun{};
    std::uint64_t light = 0;
    bool ready = false;
    std::uint64_t marched = 0, recalled = 0;  ///< pixels, of all frames so far
};

struct UpsampleInput {
    UpsampleSettings settings;
    CameraParams camera;
    MediumView medium;              ///< its box: where rays are when no depth is known
    std::array<float, 3> to_sun{};  ///< with `light`: what is the same in pictures of one light
    std::uint64_t light = 0;
    /// Marches the pixels of a lattice into planes of its size.
    std::function<Status(const PixelLattice&, Planes&)> march;
};

/// Pixels of a frame that are marched: all where nothing is thinned out, or nothing is known yet.
PixelLattice upsample_lattice(const UpsampleSettings& settings, const CameraParams& camera,
                              int frame, bool remembers);

/// What stands behind the pixels of a lattice, out of a picture of that width, as far as `few` has
/// room for it.
void take_behind(const PixelLattice& lattice, int width, const Planes& whole, Planes& few);

/// Transmittance, three colours and depths of a picture whose `opaque_depth` is there, by the
/// upsampling and reprojection that the settings ask for; `frame` of the animation decides which
/// pixels are marched. kLimit: out of memory.
Status upsample_picture(const Context& context, const UpsampleInput& in, int frame,
                        UpsampleMemory& memory, Planes& planes);

/// Room for any thinning out that work may ask of such a picture. kLimit: out of memory.
Status reserve_upsampling(const UpsampleSettings& settings, const std::array<int, 2>& resolution,
                          bool solid, UpsampleMemory& memory);

/// As before the first picture.
void forget_pictures(UpsampleMemory& memory);

/// Settings that are none; `method` names their keys.
Status check_upsampling(const Scene& scene, const char* method, const UpsampleSettings& settings);

/// The marched pixels of the work of a frame, and settings with them.
FrameWork work_of(const UpsampleSettings& settings);
void put_work(const FrameWork& work, UpsampleSettings& settings);

/// What of it the plan tells.
void note_upsampling(const Scene& scene, const UpsampleSettings& settings, Plan& plan);

/// UpsampleMemory and the counts beside it; `last` uses them last.
void add_upsample_row(const UpsampleSettings& settings, const std::array<int, 2>& resolution,
                      bool solid, bool half_depth, bool optical_depth, Stage last,
                      MemoryTable& table);

}  // namespace pileus
