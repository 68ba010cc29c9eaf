// SPDX-License-Identifier: Apache-2.0
// What of a picture is left until its pixels are written: the background, and pixels between
// marched ones. in: what a method would have filled planes by -> out: one pass over the rows.
// docs/realtime.md, "One pass after the march"
#pragma once
#include "kernels_cpu/display/finish_params.h"
#include "src/picture/pixels.h"
#include "src/picture/upsample.h"
#include "src/world/light/lights.h"

namespace pileus {

/// Pointers lead into the run, the planes and `map`; they hold until the next picture.
struct LateRows {
    bool ready = false;  ///< the planes have no background
    FinishParams params{};
    FinishBuffers buffers{};
    Buffer<float> map;     ///< light scattered onto the ground
    PixelLattice marched;  ///< pixels whose solid depth is read before the pixels are written
};

/// `late` where nothing but the background, and pixels between marched ones, lies between the march
/// and the pixels, and no later picture reads these; null where solids, an image of them, lamps or
/// shining media come in between, pictures are reprojected, or `late` is null.
LateRows* late_rows_of(LateRows* late, const Lighting& light, const Medium& medium,
                       const UpsampleSettings& thin, const CameraParams& camera, int frame);

/// Leaves the background to the last pass. Only the solid depths of marched pixels are made now,
/// where there are any. `light` has neither solids nor an image of them.
Status leave_background(const Context& context, const BackgroundParams& k,
                        const BackgroundBuffers& b, LateRows& late);

/// Leaves the pixels between those that were marched.
void leave_upsampling(const UpsampleParams& k, const UpsampleBuffers& b, LateRows& late);

/// Whether pixels of this kind can be written in that pass.
bool is_late(const PixelTarget& target, const KernelTable& kernels);

/// The same bytes as all stages one after the other and write_pixels. kLimit: out of memory.
Status finish_picture(const Context& context, const Planes& planes, int width, int height,
                      const PixelTarget& target, LateRows& late, std::uint64_t& broken);

}  // namespace pileus
