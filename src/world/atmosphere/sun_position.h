// SPDX-License-Identifier: Apache-2.0
// Where the sun stands for an observer at a date and time.
// in: date, time, longitude, latitude -> out: azimuth, elevation, the sun's distance.
// Reda & Andreas 2004 (NREL/TP-560-34302), with the larger of its terms; docs/atmosphere.md.
#pragma once
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

}  // namespace pileus
