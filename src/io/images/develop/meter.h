// SPDX-License-Identifier: Apache-2.0
// Exposure by percentiles of luminance.
// in: a histogram of luminance -> out: a gain.
// docs/exposure.md, "Automatic exposure"
#pragma once
#include <cstdint>

#include "kernels_cpu/display/tone.h"
#include "src/base/buffer.h"

namespace pileus {

/// Luminances of a picture, 128 bins in each octave of the positive floats.
class Meter {
public:
    Status prepare();
    /// Luminance that is not positive and finite is left out.
    void add(Rgb<float> radiance);
    /// The gain of an automatic exposure; kDaylightGain where nothing was added. A power of two in
    /// all radiances is its reciprocal in the gain, to the bit, while they are normal floats.
    float gain() const;

private:
    /// The lower edge of the bin that holds rank share of those counted, counted from the darkest;
    /// the first `below` of them are left out.
    float percentile(std::uint64_t below, double share) const;
    /// Mean of the logarithm from the first to the third quartile.
    float middle(std::uint64_t below) const;

    Buffer<std::uint32_t> bins_;
    std::uint64_t total_ = 0;
};

}  // namespace pileus
