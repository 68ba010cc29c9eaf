// SPDX-License-Identifier: Apache-2.0
// See meter.h.
// in: luminances -> out: a gain. Whole numbers up to the last step, so that no order of pixels and
// no scale by a power of two changes it.
#include "src/io/images/develop/meter.h"

#include <algorithm>
#include <cstring>

namespace pileus {
namespace {

constexpr std::uint32_t kMeterBins = 1u << 15, kMeterShift = 16;

float float_of_bits(std::uint32_t bits) {
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

}  // namespace

Status Meter::prepare() {
    total_ = 0;
    return bins_.resize(kMeterBins, "brightness histogram");
}

void Meter::add(Rgb<float> radiance) {
    const float y = luminance(radiance);
    if (!(y > 0.0f && y <= 3.402823466e38f)) return;
    std::uint32_t bits;
    std::memcpy(&bits, &y, sizeof bits);
    ++bins_[bits >> kMeterShift];
    ++total_;
}

float Meter::percentile(std::uint64_t below, double share) const {
    const std::uint64_t rank = below + std::uint64_t(share * double(total_ - below));
    std::uint64_t passed = 0;
    for (std::uint32_t i = 0; i < kMeterBins; ++i) {
        passed += bins_[i];
        if (passed > rank) return float_of_bits(i << kMeterShift);
    }
    return 0.0f;
}

float Meter::middle(std::uint64_t below) const {
    const std::uint64_t count = total_ - below;
    std::uint64_t first = below + count / 4, last = total_ - count / 4, passed = 0, sum = 0;
    if (first >= last) last = first + 1;
    for (std::uint32_t i = 0; i < kMeterBins; ++i) {
        const std::uint64_t from = std::max(passed, first);
        passed += bins_[i];
        const std::uint64_t to = std::min(passed, last);
        if (to > from) sum += (to - from) * i;
    }
    // The bits of a float are its logarithm, straight between powers of two.
    return float_of_bits(std::uint32_t((sum << kMeterShift) / (last - first)));
}

float Meter::gain() const {
    if (total_ == 0) return kDaylightGain;
    // What is ten stops darker than the bright parts is black in any picture of them.
    const float black = percentile(0, 0.95) * 0x1p-10f;
    std::uint64_t below = 0;
    for (std::uint32_t i = 0; i < kMeterBins && float_of_bits(i << kMeterShift) < black; ++i)
        below += bins_[i];
    const float middle_y = std::max(middle(below), 1e-36f);
    const float bright = std::min(percentile(below, 0.99), 16 * percentile(below, 0.95));
    const float by_bright = 1.25f / std::max(bright, 1e-36f);
    const float gain = std::min(by_bright, 0.35f / middle_y);
    return gain * middle_y < 0.04f ? std::min(0.04f / middle_y, gain * 4) : gain;
}

}  // namespace pileus
