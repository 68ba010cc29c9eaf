// SPDX-License-Identifier: Apache-2.0
// Where the moon stands for an observer at a date and time, how it is lit, and how bright it is.
// in: date, time, longitude, latitude -> out: azimuth, elevation, distance, phase, its light.
// Meeus 1998, chapters 40, 47, 48, with the larger terms; Allen 1976 (light by phase);
// docs/atmosphere.md, "Night".
#pragma once
#include <array>

#include "src/base/vectors.h"
#include "src/scene/calendar.h"

namespace pileus {

constexpr double kMoonMeanKm = 384400;
/// Half of the moon's breadth at that distance.
constexpr double kMoonRadiusDeg = 0.2591;

/// From the earth's middle, in the ecliptic of the date, without nutation.
struct MoonPlace {
    double longitude_deg = 0, latitude_deg = 0, distance_km = 0;
};
/// `centuries` of terrestrial time since 2000. Within 0.01 degrees and 20 km of all terms.
MoonPlace moon_place(double centuries);

struct MoonPosition {
    double azimuth_deg = 0;    ///< from north over east, [0, 360)
    double elevation_deg = 0;  ///< of its middle, without refraction
    double distance_km = 0;    ///< from the observer
    double phase_deg = 0;      ///< between sun and observer as seen from it: 0 full, 180 new
    Double3 to_sun{0, 0, 1};   ///< unit vector from it to the sun: east, north, up

    /// Share of its disc that is lit.
    double lit() const { return 0.5 * (1 + cosine_of_phase); }
    double cosine_of_phase = 1;
};

/// Seen from the place itself, not from the earth's middle. `latitude_deg` in [-90, 90].
MoonPosition moon_position(const Moment& moment, double latitude_deg, double longitude_deg,
                           double height_m = 0);

/// Its light over the sun's, both above the air, in R G B of which the sun's is white: magnitude
/// -12.73 + 0.026 phase + 4e-9 phase^4 against -26.74, a little red (B-V of 0.92 against 0.65).
/// The crescent that the formula does not tell (lit less than 1/200) goes to 0 with what is lit.
std::array<double, 3> moon_light(const MoonPosition& moon);

}  // namespace pileus
