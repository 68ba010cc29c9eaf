// SPDX-License-Identifier: Apache-2.0
// The angle of a vector in double: libm's bits differ between machines.
// in: x, y -> out: degrees in [-180, 180], within 1e-13; 0 at the origin.
// Newton's iteration on sincos_deg from a polynomial; only + - * / and square roots.
#pragma once
#include "src/base/angles.h"

namespace pileus {

/// Of (x, y) from the x axis towards y.
inline double angle_of_deg(double y, double x) {
    const double length = __builtin_sqrt(x * x + y * y);
    if (!(length > 0)) return 0;
    const double c = x / length, s = y / length;
    const double ax = c < 0 ? -c : c, ay = s < 0 ? -s : s;
    // Within two degrees in the octant.
    const double low = ax < ay ? ax : ay, high = ax < ay ? ay : ax;
    const double t = low / high;
    double degrees = t * (57.2957795 - t * t * 12.3);
    if (ay > ax) degrees = 90 - degrees;
    if (c < 0) degrees = 180 - degrees;
    if (s < 0) degrees = -degrees;
    for (int i = 0; i < 4; ++i) {
        const SineCosine at = sincos_deg(degrees);
        // sin of what is missing, and its series.
        const double d = s * at.cosine - c * at.sine;
        degrees += d * (1 + d * d / 6) * 57.295779513082320877;
    }
    return degrees;
}

}  // namespace pileus
