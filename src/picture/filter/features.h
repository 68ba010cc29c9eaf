// SPDX-License-Identifier: Apache-2.0
// What is known of a pixel without noise, as numbers that its light is a linear function of.
// in: transmittance, optical depth, guides, sunlight on the ground -> out: features and weights.
// docs/filter.md
#pragma once
#include "src/picture/filter/regression.h"

namespace pileus {

/// Features and weight of a pixel, side by side; weight 0: not of the group.
constexpr int kFilterStored = kFilterFeatures + 1;

/// Of light that media turn: of pixels with something solid behind the media, or of the others.
void media_features(const RegressionInput& in, bool opaque, float* out);

/// Of light that the ground sends straight through the media.
void ground_features(const RegressionInput& in, float* out);

}  // namespace pileus
