// SPDX-License-Identifier: Apache-2.0
// The sRGB curve backwards, and forwards in one step, the same bits on every machine.
// in: an encoded value in [0, 1], or light -> out: light in [0, 1], or 8 bits.
// IEC 61966-2-1; docs/formats.md
#pragma once
#include <cstring>

#include "kernels_cpu/display/pixel_params.h"
#include "kernels_cpu/display/tone.h"
#include "src/base/powers.h"

namespace pileus {

/// Display-linear light of an encoded value; kernels_cpu/display/tone.h has the way back.
inline double linear_of_srgb(double v) {
    return v <= 0.04045 ? v / 12.92 : power_of((v + 0.055) / 1.055, 2.4);
}

/// srgb_code of any float, by one look-up and one comparison: no 128th of an octave holds more than
/// one of its thresholds (tests/io/tone_test.cpp).
class SrgbCodes {
public:
    SrgbCodes() {
        for (std::uint32_t i = 0; i < kCodeBins; ++i) {
            const std::uint32_t bits = kCodeLowest + (i << kCodeShift);
            float edge;
            std::memcpy(&edge, &bits, sizeof edge);
            code_[i] = std::int32_t(srgb_code(edge));
        }
    }
    std::uint8_t operator()(float linear) const {
        if (!(linear >= 0x1p-13f)) return 0;  // NaN, too
        if (linear >= 1.0f) return 255;
        std::uint32_t bits;
        std::memcpy(&bits, &linear, sizeof bits);
        const std::int32_t code = code_[(bits - kCodeLowest) >> kCodeShift];
        // Light below 1 may have reached the last threshold, after which none comes.
        return std::uint8_t(code + (code < 255 && linear >= kSrgbThresholds[code] ? 1 : 0));
    }
    /// [kCodeBins]: the code at the start of each bin, as kernels read it.
    const std::int32_t* bins() const { return code_; }

private:
    std::int32_t code_[kCodeBins];
};

}  // namespace pileus
