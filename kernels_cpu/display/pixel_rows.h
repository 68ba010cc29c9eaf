// SPDX-License-Identifier: Apache-2.0
// Planes of a picture as 8-bit sRGB pixels, replacing what the caller's memory held.
// in: PixelParams, PixelBuffers -> out: rows of R G B A, values that are no number per row.
// The bits of write_pixels' own way; docs/embedding.md, "Pixels".
#pragma once
#include "kernels_cpu/core/pixel_block.h"
#include "kernels_cpu/display/pixel_params.h"
#include "kernels_cpu/display/tone.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Code of display-linear light in [0, 1.04), by one look-up and one comparison: no bin holds more
/// than one threshold.
template <class T>
PILEUS_FN auto code_of(const std::int32_t* codes, T linear) {
    using II = I_of<T>;
    const T within = min_(max_(linear, all<T>(0x1p-13f)), all<T>(0x1.fffffep-1f));
    const II place = reinterpret<II>(within) - std::int32_t(kCodeLowest);
    const II bin = gather(codes, place >> std::int32_t(kCodeShift));
    const II rest = place & std::int32_t(kCodeRest);
    const II code = bin >> std::int32_t(kCodeShift + 1);
    return select(rest >= (bin & std::int32_t(2 * kCodeRest + 1)), code + 1, code);
}

/// W pixels of this light, the first `real` of them.
template <int W>
PILEUS_FN void store_pixels(const std::int32_t* codes, float gain, F<W> transmittance,
                            const F<W> (&light)[3], std::int32_t real, unsigned char* to,
                            std::int64_t& broken) {
    using T = F<W>;
    T c[3];
    for (int i = 0; i < 3; ++i) {
        const auto sound = light[i] - light[i] == 0.0f;
        broken += W - count_bits(bits_of(sound));
        c[i] = select(light[i] > 0.0f, light[i], T{});
    }
    const Rgb<T> shown = tone_curve(Rgb<T>{c[0], c[1], c[2]}, gain);
    const I<W> r = code_of(codes, shown.r), g = code_of(codes, shown.g),
               blue = code_of(codes, shown.b);
    const I<W> a = to_int((1.0f - transmittance) * 255.0f + 0.5f) & 255;
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    const I<W> word = r | (g << 8) | (blue << 16) | (a << 24);
#else
    const I<W> word = (r << 24) | (g << 16) | (blue << 8) | a;
#endif
    if (real >= W) {
        __builtin_memcpy(to, &word, sizeof word);
        return;
    }
    for (int l = 0; l < real; ++l) {
        const std::int32_t one = lane(word, l);
        __builtin_memcpy(to + 4 * l, &one, sizeof one);
    }
}

/// W pixels from number `first` on, `real` of them.
template <int W>
PILEUS_FN void pixel_lanes(const PixelParams& k, const PixelBuffers& b, std::int64_t first,
                           std::int32_t real, unsigned char* to, std::int64_t& broken) {
    using T = F<W>;
    const std::int64_t pixels = std::int64_t(k.width) * k.height;
    const T transmittance = take_lanes<T>(b.transmittance + first, real);
    T light[3];
    for (int i = 0; i < 3; ++i) {
        light[i] = take_lanes<T>(b.colour + i * pixels + first, real);
        if (b.background != nullptr)
            light[i] =
                light[i] + transmittance * take_lanes<T>(b.background + i * pixels + first, real);
    }
    store_pixels<W>(b.codes, k.gain, transmittance, light, real, to, broken);
}

template <int W>
PILEUS_FN void pixel_rows(const PixelParams& k, const PixelBuffers& b, std::uint32_t begin,
                          std::uint32_t end) {
    for (std::uint32_t y = begin; y < end; ++y) {
        unsigned char* row = b.first + b.stride * std::int64_t(y);
        std::int64_t broken = 0;
        for (std::int32_t x = 0; x < k.width; x += W) {
            const std::int32_t real = k.width - x < W ? k.width - x : W;
            pixel_lanes<W>(k, b, std::int64_t(y) * k.width + x, real, row + std::int64_t(4) * x,
                           broken);
        }
        b.broken[y] = broken;
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
