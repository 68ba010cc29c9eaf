// SPDX-License-Identifier: Apache-2.0
// Error of one setting from several seeds, bias and noise apart, the reference's noise taken off.
// in: pictures of one setting, two halves of a reference -> out: relMSE, bias^2, noise.
// docs/study.md, "Bias and noise apart"
#pragma once
#include <vector>

#include "src/base/status.h"
#include "src/io/images/image.h"

namespace pileus {

/// All of them relMSE: mean over the cloud's pixels and colours of (...)/(r^2 + eps), r^2
/// smooth as compare_with_halves has it. With one
/// seed bias2 and noise are unknown (NaN), with two their standard error is.
struct ErrorSplit {
    double relmse = 0, relmse_error = 0;  ///< mean over the seeds; its standard error
    double bias2 = 0, bias2_error = 0;    ///< of the mean picture; jackknife over the seeds
    double noise = 0;                     ///< variance of one picture
    double mean_bias = 0;                 ///< mean (a - r) / mean r, all seeds
    std::vector<double> each;             ///< relMSE of each seed
};

/// What a reference can show.
struct ReferenceNoise {
    double noise = 0;       ///< relMSE of the mean of the halves
    double resolution = 0;  ///< one standard error of a relMSE, from the halves' noise alone
    double mean = 0;        ///< mean radiance over the counted pixels
    std::uint64_t cloud_pixels = 0;
};

/// Errors: kBadInput for different sizes or missing channels, no pixel of cloud.
Status reference_noise(const Image& half1, const Image& half2, ReferenceNoise& noise);

/// relMSE as compare_with_halves (lab/compare/metrics.h) has it, for all pictures at once.
Status split_error(const std::vector<Image>& pictures, const Image& half1, const Image& half2,
                   ErrorSplit& split);

/// The same from the matrix G[i][j] = mean (x_i - r1)(x_j - r2)/(r^2 + eps), symmetric, K x K.
void split_matrix(const std::vector<double>& matrix, int seeds, ErrorSplit& split);

}  // namespace pileus
