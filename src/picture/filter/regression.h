// SPDX-License-Identifier: Apache-2.0
// Takes noise out of light by local regressions on what is known of each pixel without noise.
// in: noisy light, alpha, optical depth, guides -> out: smooth light of nearly the same sum.
// docs/filter.md; James and Stein 1961 for the shrinkage.
#pragma once
#include "src/base/span.h"
#include "src/picture/errors/pixel_errors.h"
#include "src/plan/array.h"

namespace pileus {

/// Numbers of a pixel that its light is a linear function of, within a window.
constexpr int kFilterFeatures = 7;

struct RegressionInput {
    int width = 0, height = 0;
    int threads = 1;
    const float* transmittance = nullptr;  ///< [pixel]
    const float* optical_depth = nullptr;  ///< [pixel]
    const float* guides = nullptr;         ///< [3][pixel]
    const float* opaque_depth = nullptr;   ///< [pixel]; infinity for the sky; null: sky alone
    const float* sun_on_ground = nullptr;  ///< [pixel], the share of it that media let through
    int radius_pixels = 0;                 ///< of all windows; 0: several, by the noise
    int fold = -1;  ///< pixels of that corner of each 2 x 2 square alone, 0 to 3; -1: all
    /// Of filter_kept: what windows keep of their fits. All pixels leave it, parts take it up, so
    /// that they differ from the whole by noise alone; null: each finds its own.
    double* kept = nullptr;
};

/// The corner of its square of 2 x 2 that a pixel is.
constexpr int filter_fold(int x, int y) { return (x & 1) + 2 * (y & 1); }

namespace arrays {

/// Features, sums and coefficients.
Array<float> filter_features(std::uint64_t pixels);
Array<double> filter_sums(int width, int height);
Array<double> filter_kept(int width, int height);

}  // namespace arrays

/// Replaces `light`, [3][pixel], of pixels that show medium by what the regressions say of it.
/// Pixels with sky behind them and others are filtered apart. Same bits for any number of threads.
/// kLimit: out of memory.
Status filter_light(const RegressionInput& in, float* light);

/// The same of light that comes from an even ground straight through the media, of all pixels with
/// something solid. Needs transmittance, opaque_depth and sun_on_ground alone.
Status filter_ground(const RegressionInput& in, float* light);

}  // namespace pileus
