// SPDX-License-Identifier: Apache-2.0
// What the last pass over a picture needs: background, pixels between marched ones, 8-bit codes.
// in: light of the media, all or marched pixels -> out: the layout of a launch.
// docs/realtime.md, "One pass after the march"
#pragma once
#include "kernels_cpu/display/pixel_params.h"
#include "kernels_cpu/display/upsample_params.h"

namespace pileus {

struct FinishParams {
    BackgroundParams back;
    UpsampleParams up;  ///< unused unless `filled`; remembers nothing
    PixelParams pixel;
    std::int32_t filled;  ///< 1: pixels were marched on a lattice; 0: each has its light
};

struct FinishBuffers {
    BackgroundBuffers back;  ///< of it what is read
    UpsampleBuffers up;      ///< likewise
    PixelBuffers pixel;      ///< planes are unused where `filled`
};

}  // namespace pileus
