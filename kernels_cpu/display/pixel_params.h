// SPDX-License-Identifier: Apache-2.0
// What showing a picture in 8 bits needs: plain structs and pointers.
// in: planes of a picture, the caller's rows -> out: the layout of a launch.
// docs/embedding.md, "Pixels"
#pragma once
#include <cstdint>

namespace pileus {

/// Codes of display-linear light by the floats' first 16 bits, from kCodeLowest on, below 1. A bin
/// holds the code at its start times 2^(kCodeShift + 1), and the rest of the bits at which the next
/// code begins, or more than any where none does.
constexpr std::uint32_t kCodeShift = 16, kCodeRest = (1u << kCodeShift) - 1, kCodeBins = 13 * 128;
constexpr std::uint32_t kCodeLowest = (127 - 13) << 23;  // bits of 2^-13

struct PixelParams {
    std::int32_t width, height;
    float gain;
};

struct PixelBuffers {
    const float* transmittance;  ///< [pixel]
    const float* colour;         ///< [3][pixel]
    const float* background;     ///< [3][pixel]; null: none
    const std::int32_t* codes;   ///< [kCodeBins]: as said above
    unsigned char* first;        ///< the row that holds the picture's top
    std::int64_t stride;         ///< bytes from one of the picture's rows to the next
    std::int64_t* broken;        ///< [row]: values that are no number, or infinite
};

}  // namespace pileus
