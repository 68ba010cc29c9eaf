// SPDX-License-Identifier: Apache-2.0
// Pictures of a comparison: differences, differences in standard errors, FLIP.
// in: two pictures, or a FlipResult -> out: values for .exr and .pfm, colours for .png and .ppm.
// docs/compare.md, "Pictures"
#pragma once
#include "lab/compare/flip.h"
#include "src/base/status.h"
#include "src/io/images/image.h"

namespace pileus {

/// R G B = a - r where a pixel counts (metrics.h), else 0; A = 1 where it counts, 0 elsewhere. A
/// counted pixel that is not finite is NaN. Faults: those of compare_images.
Status difference_picture(const Image& a, const Image& reference, double alpha_least, Image& out);

/// The same with z = (a - r)/sqrt(se_a^2 + se_r^2); 0 and A = 0 where that error is 0. No error
/// layer in either: kBadInput.
Status z_picture(const Image& a, const Image& reference, double alpha_least, Image& out);

/// Y = FLIP's value per pixel.
Status flip_picture(const FlipResult& result, Image& out);

/// Colours of the mean of R G B: white for 0, red for +scale and above, blue for -scale and below;
/// grey where A = 0, yellow for NaN. A scale that is not positive: 1.
Status signed_colours(const Image& values, double scale, Image& out);

/// FLIP's values from black (0) through violet to pale yellow (1): the colour map magma.
Status flip_colours(const FlipResult& result, Image& out);

}  // namespace pileus
