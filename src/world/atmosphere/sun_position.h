// SPDX-License-Identifier: Apache-2.0
// Where the sun stands for an observer at a date and time.
// in: date, time, longitude, latitude -> out: azimuth, elevation, the sun's distance.
// Reda & Andreas 2004 (NREL/TP-560-34302), with the larger of its terms; docs/atmosphere.md.
#pragma once
#include "src/base/angles.h"
#include "src/scene/calendar.h"

namespace pileus {

struct SunPosition {
    double azimuth_deg = 0;    ///< from north over east, [0, 360)
    double elevation_deg = 0;  ///< of its middle, without refraction
    double distance_au = 1;
};

/// Within 0.001 degrees of the full algorithm from 1950 to 2050. `latitude_deg` in [-90, 90].
SunPosition sun_position(const Moment& moment, double latitude_deg, double longitude_deg,
                         double height_m = 0);

/// How much higher than it is the sun is seen through the air at this true elevation, degrees:
/// Saemundsson's formula at 1013 hPa and 15 C, falling to 0 from 1 to 3 degrees below the horizon.
double refraction_deg(double elevation_deg, double pressure_hpa = 1013.25,
                      double temperature_c = 15);

// The angle of a vector in double: libm's bits differ between machines. By Newton's iteration on
// sincos_deg from a polynomial; only + - * / and square roots. In degrees in [-180, 180], within
// 1e-13; 0 at the origin.

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
