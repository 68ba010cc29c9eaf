// SPDX-License-Identifier: Apache-2.0
// How far one picture is from another: errors, their noise, and whether a bias is real.
// in: two pictures of one size -> out: Metrics, sums of doubles in a fixed order.
// docs/compare.md
#pragma once
#include <cstdint>
#include <limits>

#include "src/base/status.h"
#include "src/io/images/image.h"

namespace pileus {

struct MetricOptions {
    /// Only pixels whose alpha in the reference is above this count; negative: all pixels. A
    /// reference without alpha counts with all pixels.
    double alpha_least = 0.02;
    bool flip = false;  ///< measure flip_mean too, which takes longer than all the rest
    int threads = 0;    ///< for FLIP alone; 0: as many as the machine has
};

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// Every figure is over the counted pixels (finite in both pictures, alpha above the least) and
/// the channels R G B. d = a - r; eps = (0.01 mean_reference)^2. kNotKnown is a NaN.
struct Metrics {
    std::uint64_t pixels = 0;        ///< of a picture
    std::uint64_t cloud_pixels = 0;  ///< counted ones
    std::uint64_t not_finite = 0;    ///< alpha above the least, but not finite in one or both
    bool has_alpha = false;          ///< whether the reference has one
    bool has_error_a = false, has_error_reference = false;
    bool identical = false;  ///< no counted value differs: then no noise is taken off

    double mean_a = 0, mean_reference = 0;
    double rmse = 0;            ///< sqrt(mean d^2), noise of both included
    double relmse_raw = 0;      ///< mean d^2/(r^2 + eps)
    double relmse_trimmed = 0;  ///< the same without the largest 0.1 % of the terms
    /// relmse_raw - relmse_reference_noise; can be negative. 0 for identical pictures, whose noise
    /// is the same.
    double relmse = 0;
    double relmse_reference_noise = 0;  ///< mean se_r^2/(r^2 + eps); 0 where not known
    double relmse_own_noise = 0;        ///< mean se_a^2/(r^2 + eps); 0 where not known
    double largest = 0;                 ///< max |d|
    int largest_x = 0, largest_y = 0;
    /// Of pixels that are finite, but do not count, since their alpha is too low.
    double uncounted_largest = 0;
    int uncounted_x = 0, uncounted_y = 0;
    std::uint64_t uncounted_not_finite = 0;  ///< pixels beside those that are not finite
    double percentile_999 = 0;               ///< 99.9 % of all |d| are at most this
    double relative_percentile_999 = 0;      ///< the same of |d|/sqrt(r^2 + eps)

    double bias = 0;  ///< mean d
    /// Of bias, pixels independent of each other, the three channels of a pixel wholly dependent.
    double bias_standard_error = kNotKnown;
    double bias_standard_error_most = kNotKnown;  ///< where all pixels err together: the most
    double bias_z = kNotKnown, bias_z_least = kNotKnown;  ///< bias over each of them

    std::uint64_t z_count = 0;    ///< values d/sqrt(se_a^2 + se_r^2) with a standard error above 0
    std::uint64_t z_unknown = 0;  ///< values that differ although their standard error is 0
    double z_above_2 = 0, z_above_3 = 0;  ///< shares of |z| above 2 and 3 (normal: 0.0455, 0.0027)
    double z_square_mean = 0;             ///< mean z^2: 1 where the error bars explain all

    double flip_mean = kNotKnown;  ///< HDR-FLIP (LDR where both are 8-bit), mean over all pixels
};

/// Compares `a` with `reference`. Both need R G B (or Y); channels error.R/G/B are their standard
/// errors where present. Different sizes, missing channels, no pixel to count: kBadInput; memory:
/// kLimit. Sources: docs/compare.md.
Status compare_images(const Image& a, const Image& reference, const MetricOptions& options,
                      Metrics& metrics);

/// Compares `a` with the mean of two independent halves of a reference. Their difference gives the
/// reference's noise: relmse = mean (a - r1)(a - r2)/(r^2 + eps), whose expectation does not hold
/// it; r^2 is a local mean of r1 r2 (smooth_squares), or its noise would raise the figure. z
/// figures are left out: one difference is no estimate of a pixel's own error. Errors as above.
Status compare_with_halves(const Image& a, const Image& half1, const Image& half2,
                           const MetricOptions& options, Metrics& metrics);

/// Mean of two halves as a picture R G B A with |half1 - half2|/2 as layers error.R/G/B. Different
/// sizes or missing channels: kBadInput; memory: kLimit.
Status merge_halves(const Image& half1, const Image& half2, Image& reference);

/// "WHAT: sizes: differ, ..." unless both pictures have one size; `what` opens the line.
Status check_same_size(const char* what, const Image& a, const Image& b);

}  // namespace pileus
