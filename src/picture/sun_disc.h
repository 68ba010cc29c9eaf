// SPDX-License-Identifier: Apache-2.0
// The sun and the moon themselves in a picture's sky: discs, alike all over what shines of them.
// in: a camera, where one stands, what is before it -> out: light added to pixels.
// docs/atmosphere.md, "In front of things", "Night"
#pragma once
#include <array>

#include "kernels_cpu/core/camera.h"
#include "src/base/span.h"

namespace pileus {

/// Half of 32 arc minutes, as the sun is seen on the average.
constexpr double kSunRadiusDeg = 0.2665;

struct SunDisc {
    float to_sun[3];                     ///< unit vector
    double radius_deg = kSunRadiusDeg;   ///< above 0
    std::array<double, 3> irradiance{};  ///< on a plane that faces it, at the camera
    double horizon = -1;                 ///< cosine to the vertical below which the earth hides it
    /// Of a ball that is lit from aside: the direction of what lights it, unit vector; the
    /// irradiance is that of the lit part. All zero: all of the disc shines.
    std::array<double, 3> lit_from{};
};

/// Adds the radiance to `behind`, [3][pixel], by the share of each pixel that the disc covers.
/// Pixels with something solid before the sky, `opaque_depth` less than 1e30 m, have none of it;
/// empty: nothing is solid. `transmittance` multiplies it; empty: 1. Perspective cameras alone.
void add_sun_disc(const CameraParams& camera, const SunDisc& disc, Span<const float> opaque_depth,
                  Span<const float> transmittance, float* behind);

}  // namespace pileus
