// SPDX-License-Identifier: Apache-2.0
// FLIP: how strongly two pictures differ to an eye that flips between them.
// in: two pictures R G B -> out: a value in [0, 1] for every pixel, their mean, the exposures used.
// Andersson et al. 2020 (LDR), 2021 (HDR); docs/compare.md
#pragma once
#include <cstdint>

#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/io/images/image.h"

namespace pileus {

enum class FlipTone { kAces, kHable, kReinhard };

struct FlipOptions {
    /// Light of the world, seen at many exposures; false: light of a display in [0, 1], seen once.
    bool hdr = true;
    FlipTone tone = FlipTone::kAces;
    /// A screen 0.7 m wide of 3840 pixels, seen from 0.7 m: the published default.
    double pixels_per_degree = 67.020643276;
    int threads = 0;  ///< 0: as many as the machine has; any number gives the same bits
};

struct FlipResult {
    int width = 0, height = 0;
    Buffer<float> value;  ///< [0, 1] per pixel, rows from the top
    double mean = 0, largest = 0;
    double percentile_99 = 0;      ///< 99 % of the pixels are at most this
    double start = 0, stop = 0;    ///< exposures in stops; HDR only
    int exposures = 1;             ///< how many, evenly spaced from start to stop
    std::uint64_t not_finite = 0;  ///< values replaced: NaN by 0, infinity by the largest float
};

/// Compares `a` with `reference`, over all pixels. Negative light counts as none. Different sizes,
/// missing channels, pixels_per_degree outside [1, 1000]: kBadInput; memory: kLimit.
Status flip(const Image& a, const Image& reference, const FlipOptions& options, FlipResult& result);

}  // namespace pileus
