// SPDX-License-Identifier: Apache-2.0
// See earth_turn.h. Equations by their numbers in Reda & Andreas 2004.
#include "src/world/atmosphere/earth_turn.h"

#include <initializer_list>

namespace pileus {
namespace {

double whole_below(double x) {
    const double cut = double(static_cast<long long>(x));
    return cut > x ? cut - 1 : cut;
}

/// TT - UT in seconds: Espenak & Meeus 2006, their polynomials from 1900 to 2100.
double dynamical_lag_s(double year) {
    const auto sum = [](double t, std::initializer_list<double> c) {
        double s = 0, p = 1;
        for (const double k : c) s += k * p, p *= t;
        return s;
    };
    if (year < 1920) return sum(year - 1900, {-2.79, 1.494119, -0.0598939, 0.0061966, -0.000197});
    if (year < 1941) return sum(year - 1920, {21.20, 0.84493, -0.076100, 0.0020936});
    if (year < 1961) {
        const double t = year - 1950;
        return 29.07 + 0.407 * t - t * t / 233 + t * t * t / 2547;
    }
    if (year < 1986) {
        const double t = year - 1975;
        return 45.45 + 1.067 * t - t * t / 260 - t * t * t / 718;
    }
    if (year < 2005)
        return sum(year - 2000, {63.86, 0.3345, -0.060374, 0.0017275, 0.000651814, 0.00002373599});
    if (year < 2050) return sum(year - 2000, {62.92, 0.32217, 0.005589});
    const double u = (year - 1820) / 100;
    return -20 + 32 * u * u - 0.5628 * (2150 - year);
}

/// Nutation in longitude and obliquity, degrees: the four largest terms (Meeus 1998, chapter 22),
/// within 0.5 arc seconds.
void nutation(double centuries, double& in_longitude, double& in_obliquity) {
    const double node = 125.04452 - 1934.136261 * centuries;
    const double sun = 280.4665 + 36000.7698 * centuries;
    const double moon = 218.3165 + 481267.8813 * centuries;
    in_longitude = (-17.20 * sine(node) - 1.32 * sine(2 * sun) - 0.23 * sine(2 * moon) +
                    0.21 * sine(2 * node)) /
                   3600;
    in_obliquity = (9.20 * cosine(node) + 0.57 * cosine(2 * sun) + 0.10 * cosine(2 * moon) -
                    0.09 * cosine(2 * node)) /
                   3600;
}

}  // namespace

double within_turn(double degrees) { return degrees - 360 * whole_below(degrees / 360); }

EarthTurn earth_turn(double jd) {
    const double year = 2000 + (jd - 2451544.5) / 365.2425;
    const double centuries_ut = (jd - 2451545) / 36525;
    EarthTurn out;
    out.centuries = (jd + dynamical_lag_s(year) / 86400 - 2451545) / 36525;
    const double centuries = out.centuries;
    double in_longitude = 0, in_obliquity = 0;
    nutation(centuries, in_longitude, in_obliquity);
    // Eq. 24, 25: the mean obliquity's first terms do for these centuries.
    out.nutation_deg = in_longitude;
    out.obliquity_deg = 23.4392911 - centuries * (0.0130042 + centuries * 1.64e-7) + in_obliquity;
    // Eq. 28, 29.
    out.sidereal_deg = 280.46061837 + 360.98564736629 * (jd - 2451545) +
                       centuries_ut * centuries_ut * 0.000387933 +
                       in_longitude * cosine(out.obliquity_deg);
    return out;
}

}  // namespace pileus
