// SPDX-License-Identifier: Apache-2.0
// How much light of a narrow peak a picture's pixel can hold.
// in: a camera, the direction of a ray -> out: a bound on phase functions, 1/sr.
// docs/phase.md, "Narrow peaks in pictures".
#pragma once
#include "kernels_cpu/core/camera.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// One over the solid angle of the sun as it is seen on the average, 0.2665 degrees in radius,
/// 1/sr.
constexpr float kSunDensity = 14713.0f;
/// Pixels wider than 0.01 sr count as that wide.
constexpr float kWidestPixel = 0.01f;

/// The most that a phase function's mean over a pixel can be, 1/sr, along its ray `d`: all light
/// within it. One ray through the middle would show a narrower peak's height in all of the pixel,
/// more light than there is. A parallel view's pixels have no width: no light there is narrower
/// than the sun.
template <class T>
PILEUS_FN T most_density(const CameraParams& c, const Vec<T>& d) {
    if (c.orthographic != 0) return all<T>(kSunDensity);
    const float middle = min_((2.0f * c.half_width / float(whole_width(c))) *
                                  (2.0f * c.half_height / float(whole_height(c))),
                              kWidestPixel);
    const T slant =
        max_(d.x * c.forward[0] + d.y * c.forward[1] + d.z * c.forward[2], all<T>(1e-3f));
    return min_(1.0f / max_(middle * (slant * slant * slant), all<T>(1e-12f)), all<T>(kSunDensity));
}

}  // namespace PILEUS_ISA
}  // namespace pileus
