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
            const std::uint32_t code = srgb_code(edge);
            std::uint32_t next = 0;
            if (code < 255) std::memcpy(&next, &kSrgbThresholds[code], sizeof next);
            const bool within = next >> kCodeShift == bits >> kCodeShift;
            bin_[i] = std::int32_t((code << (kCodeShift + 1)) |
                                   (within ? next & kCodeRest : kCodeRest + 1));
        }
    }
    std::uint8_t operator()(float linear) const {
        if (!(linear >= 0x1p-13f)) return 0;  // NaN, too
        if (linear >= 1.0f) return 255;
        std::uint32_t bits;
        std::memcpy(&bits, &linear, sizeof bits);
        const std::uint32_t bin = std::uint32_t(bin_[(bits - kCodeLowest) >> kCodeShift]);
        const bool reached = (bits & kCodeRest) >= (bin & (2 * kCodeRest + 1));
        return std::uint8_t((bin >> (kCodeShift + 1)) + (reached ? 1u : 0u));
    }
    /// [kCodeBins], as kernels read them.
    const std::int32_t* bins() const { return bin_; }

private:
    std::int32_t bin_[kCodeBins];
};

}  // namespace pileus
