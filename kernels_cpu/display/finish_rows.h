// SPDX-License-Identifier: Apache-2.0
// The last pass over a picture: what is behind the media, pixels between marched ones, 8-bit codes.
// in: FinishParams, FinishBuffers -> out: rows of R G B A. No plane of the whole picture is written
// in between; the bits of background_rows, upsample_rows and pixel_rows one after the other.
#pragma once
#include "kernels_cpu/display/finish_params.h"
#include "kernels_cpu/display/march_background.h"
#include "kernels_cpu/display/pixel_rows.h"
#include "kernels_cpu/display/upsample_rows.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// W pixels of row y from column x on.
template <int W>
PILEUS_FN void finish_pixels(const FinishParams& k, const FinishBuffers& b, std::int32_t x,
                             std::int32_t y, unsigned char* to, std::int64_t& broken) {
    using T = F<W>;
    const std::int32_t width = k.pixel.width, real = width - x < W ? width - x : W;
    const Behind<T> behind = background_lanes<W>(k.back, b.back, x, y, true);
    T transmittance, light[3];
    if (k.filled != 0) {
        const Filled<T> pixel = upsample_lanes<W>(k.up, b.up, x, y, real, behind.depth);
        transmittance = pixel.light.value[0];
        for (int i = 0; i < 3; ++i) light[i] = pixel.light.value[1 + i];
    } else {
        const std::int64_t pixels = std::int64_t(width) * k.pixel.height;
        const std::int64_t first = std::int64_t(y) * width + x;
        transmittance = take_lanes<T>(b.pixel.transmittance + first, real);
        for (int i = 0; i < 3; ++i)
            light[i] = take_lanes<T>(b.pixel.colour + i * pixels + first, real);
    }
    for (int i = 0; i < 3; ++i) light[i] = light[i] + transmittance * behind.colour[i];
    // Lanes beyond the picture count as sound.
    if (real < W)
        for (int i = 0; i < 3; ++i) light[i] = select(iota<I<W>>() < real, light[i], T{});
    store_pixels<W>(b.pixel.codes, k.pixel.gain, transmittance, light, real, to, broken);
}

template <int W>
PILEUS_FN void finish_rows(const FinishParams& k, const FinishBuffers& b, std::uint32_t begin,
                           std::uint32_t end) {
    for (std::uint32_t y = begin; y < end; ++y) {
        unsigned char* row = b.pixel.first + b.pixel.stride * std::int64_t(y);
        std::int64_t broken = 0;
        for (std::int32_t x = 0; x < k.pixel.width; x += W)
            finish_pixels<W>(k, b, x, std::int32_t(y), row + std::int64_t(4) * x, broken);
        b.pixel.broken[y] = broken;
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
