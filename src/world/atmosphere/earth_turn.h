// SPDX-License-Identifier: Apache-2.0
// How the earth is turned at a moment: what positions of sun, moon and stars share.
// in: a Julian day of universal time -> out: time of ephemerides, sidereal time, obliquity.
// Reda & Andreas 2004; Espenak & Meeus 2006 (TT - UT); docs/atmosphere.md.
#pragma once
#include "src/base/angles.h"

namespace pileus {

struct EarthTurn {
    double centuries = 0;      ///< of terrestrial time since 2000 January 1, noon
    double nutation_deg = 0;   ///< in longitude
    double obliquity_deg = 0;  ///< with nutation
    double sidereal_deg = 0;   ///< apparent, at Greenwich; not reduced to a turn
};

EarthTurn earth_turn(double julian_day);

/// In [0, 360).
double within_turn(double degrees);
/// Of any angle.
inline double sine(double degrees) { return sincos_deg(within_turn(degrees)).sine; }
inline double cosine(double degrees) { return sincos_deg(within_turn(degrees)).cosine; }

}  // namespace pileus
