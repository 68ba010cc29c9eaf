// SPDX-License-Identifier: Apache-2.0
// See moon_position.h. The terms are those of Meeus 1998, tables 47.A and 47.B, of at least 7e-4
// degrees; chapter 40 moves the observer off the earth's middle, chapter 48 has the phase.
#include "src/world/atmosphere/moon_position.h"

#include "src/base/powers.h"
#include "src/world/atmosphere/earth_turn.h"
#include "src/world/atmosphere/sun_position.h"

namespace pileus {
namespace {

constexpr double kAstronomicalUnitKm = 149597870.7, kEquatorKm = 6378.14;

/// Multiples of the elongation, the sun's anomaly, the moon's, its argument of latitude.
struct Term {
    signed char d, m, a, f;
    double longitude, distance;  ///< 1e-6 degrees (of 47.B latitude), m
};
constexpr Term kAlong[] = {
    {0, 0, 1, 0, 6288774, -20905355}, {2, 0, -1, 0, 1274027, -3699111},
    {2, 0, 0, 0, 658314, -2955968},   {0, 0, 2, 0, 213618, -569925},
    {0, 1, 0, 0, -185116, 48888},     {0, 0, 0, 2, -114332, -3149},
    {2, 0, -2, 0, 58793, 246158},     {2, -1, -1, 0, 57066, -152138},
    {2, 0, 1, 0, 53322, -170733},     {2, -1, 0, 0, 45758, -204586},
    {0, 1, -1, 0, -40923, -129620},   {1, 0, 0, 0, -34720, 108743},
    {0, 1, 1, 0, -30383, 104755},     {2, 0, 0, -2, 15327, 10321},
    {0, 0, 1, 2, -12528, 0},          {0, 0, 1, -2, 10980, 79661},
    {4, 0, -1, 0, 10675, -34782},     {0, 0, 3, 0, 10034, -23210},
    {4, 0, -2, 0, 8548, -21636},      {2, 1, -1, 0, -7888, 24208},
    {2, 1, 0, 0, -6766, 30824},       {1, 0, -1, 0, -5163, -8379},
    {1, 1, 0, 0, 4987, -16675},       {2, -1, 1, 0, 4036, -12831},
    {2, 0, 2, 0, 3994, -10445},       {4, 0, 0, 0, 3861, -11650},
    {2, 0, -3, 0, 3665, 14403},       {0, 1, -2, 0, -2689, -7003},
    {2, 0, -1, 2, -2602, 0},          {2, -1, -2, 0, 2390, 10056},
    {1, 0, 1, 0, -2348, 6322},        {2, -2, 0, 0, 2236, -9884},
    {0, 1, 2, 0, -2120, 5751},        {0, 2, 0, 0, -2069, 0},
    {2, -2, -1, 0, 2048, -4950},      {2, 0, 1, -2, -1773, 4130},
    {2, 0, 0, 2, -1595, 0},           {4, -1, -1, 0, 1215, -3958},
    {0, 0, 2, 2, -1110, 0},           {3, 0, -1, 0, -892, 3258},
    {2, 1, 1, 0, -810, 2616},         {4, -1, -2, 0, 759, -1897},
    {0, 2, -1, 0, -713, -2117},       {2, 2, -1, 0, -700, 2354},
};
constexpr Term kAcross[] = {
    {0, 0, 0, 1, 5128122, 0}, {0, 0, 1, 1, 280602, 0},  {0, 0, 1, -1, 277693, 0},
    {2, 0, 0, -1, 173237, 0}, {2, 0, -1, 1, 55413, 0},  {2, 0, -1, -1, 46271, 0},
    {2, 0, 0, 1, 32573, 0},   {0, 0, 2, 1, 17198, 0},   {2, 0, 1, -1, 9266, 0},
    {0, 0, 2, -1, 8822, 0},   {2, -1, 0, -1, 8216, 0},  {2, 0, -2, -1, 4324, 0},
    {2, 0, 1, 1, 4200, 0},    {2, 1, 0, -1, -3359, 0},  {2, -1, -1, 1, 2463, 0},
    {2, -1, 0, 1, 2211, 0},   {2, -1, -1, -1, 2065, 0}, {0, 1, -1, -1, -1870, 0},
    {4, 0, -1, -1, 1828, 0},  {0, 1, 0, 1, -1794, 0},   {0, 0, 0, 3, -1749, 0},
    {0, 1, -1, 1, -1565, 0},  {1, 0, 0, 1, -1491, 0},   {0, 1, 1, 1, -1475, 0},
    {0, 1, 1, -1, -1410, 0},  {0, 1, 0, -1, -1344, 0},  {1, 0, 0, -1, -1335, 0},
    {0, 0, 3, 1, 1107, 0},    {4, 0, 0, -1, 1021, 0},   {4, 0, -1, 1, 833, 0},
};

/// The four angles that terms are multiples of, and the share by which the earth's path shrinks
/// those of the sun's anomaly.
struct Angles {
    double d, m, a, f, round;
};
double angle_of(const Term& term, const Angles& at) {
    return term.d * at.d + term.m * at.m + term.a * at.a + term.f * at.f;
}
double size_of(const Term& term, const Angles& at) {
    const int times = term.m < 0 ? -term.m : term.m;
    return times == 0 ? 1 : times == 1 ? at.round : at.round * at.round;
}

/// East, north and up, at a place of this latitude, of what the equator's frame (towards its
/// meridian, east, the pole) has.
Double3 level_at(const SineCosine& latitude, const Double3& v) {
    return {v.y, v.z * latitude.cosine - v.x * latitude.sine,
            v.x * latitude.cosine + v.z * latitude.sine};
}

double length_of(const Double3& v) { return __builtin_sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

}  // namespace

MoonPlace moon_place(double t) {
    const double mean = 218.3164477 + t * (481267.88123421 - t * (0.0015786 - t / 538841));
    const Angles at{297.8501921 + t * (445267.1114034 - t * (0.0018819 - t / 545868)),
                    357.5291092 + t * (35999.0502909 - t * 0.0001536),
                    134.9633964 + t * (477198.8675055 + t * (0.0087414 + t / 69699)),
                    93.2720950 + t * (483202.0175233 - t * 0.0036539),
                    1 - t * (0.002516 + t * 0.0000074)};
    // By Venus, Jupiter and the earth's flattening.
    const double venus = 119.75 + 131.849 * t, jupiter = 53.09 + 479264.290 * t;
    double longitude = 3958 * sine(venus) + 1962 * sine(mean - at.f) + 318 * sine(jupiter);
    double latitude = -2235 * sine(mean) + 382 * sine(313.45 + 481266.484 * t) +
                      175 * (sine(venus - at.f) + sine(venus + at.f)) + 127 * sine(mean - at.a) -
                      115 * sine(mean + at.a);
    double distance = 0;
    for (const Term& term : kAlong) {
        const double angle = angle_of(term, at), size = size_of(term, at);
        longitude += size * term.longitude * sine(angle);
        distance += size * term.distance * cosine(angle);
    }
    for (const Term& term : kAcross)
        latitude += size_of(term, at) * term.longitude * sine(angle_of(term, at));
    return {within_turn(mean + longitude * 1e-6), latitude * 1e-6, 385000.56 + distance * 1e-3};
}

MoonPosition moon_position(const Moment& moment, double latitude_deg, double longitude_deg,
                           double height_m) {
    const EarthTurn earth = earth_turn(moment.julian_day);
    const MoonPlace place = moon_place(earth.centuries);
    const double seen = place.longitude_deg + earth.nutation_deg;
    const double beta = place.latitude_deg, tilt = earth.obliquity_deg;
    // In the equator's frame of the date, then turned to the observer's meridian.
    const double x = cosine(beta) * cosine(seen), on = cosine(beta) * sine(seen);
    const double y = on * cosine(tilt) - sine(beta) * sine(tilt);
    const double z = on * sine(tilt) + sine(beta) * cosine(tilt);
    const SineCosine turn = sincos_deg(within_turn(earth.sidereal_deg + longitude_deg));
    const Double3 from_middle{x * turn.cosine + y * turn.sine, y * turn.cosine - x * turn.sine, z};

    const SineCosine at = sincos_deg(latitude_deg);
    const double reduced = angle_of_deg(0.99664719 * at.sine, at.cosine);
    const double high = 1e-3 * height_m / kEquatorKm;
    const Double3 observer{kEquatorKm * (cosine(reduced) + high * at.cosine), 0,
                           kEquatorKm * (0.99664719 * sine(reduced) + high * at.sine)};
    const Double3 way = level_at(at, place.distance_km * from_middle - observer);

    MoonPosition out;
    out.distance_km = length_of(way);
    const double flat = __builtin_sqrt(way.x * way.x + way.y * way.y);
    out.elevation_deg = angle_of_deg(way.z, flat);
    out.azimuth_deg = within_turn(angle_of_deg(way.x, way.y));
    const SunPosition sun = sun_position(moment, latitude_deg, longitude_deg, height_m);
    const Double3 to_sun =
        sun.distance_au * kAstronomicalUnitKm * towards_deg(sun.azimuth_deg, sun.elevation_deg) -
        way;
    const double far = length_of(to_sun);
    out.to_sun = to_sun / far;
    const double back =
        -(way.x * to_sun.x + way.y * to_sun.y + way.z * to_sun.z) / (far * out.distance_km);
    out.cosine_of_phase = back > 1 ? 1 : back < -1 ? -1 : back;
    out.phase_deg = angle_of_deg(__builtin_sqrt(1 - out.cosine_of_phase * out.cosine_of_phase),
                                 out.cosine_of_phase);
    return out;
}

std::array<double, 3> moon_light(const MoonPosition& moon) {
    const double phase = moon.phase_deg, square = phase * phase;
    const double magnitude = -12.73 + 0.026 * phase + 4e-9 * square * square;
    constexpr double kTenth = 0.4 * 3.3219280948873623479;  // log2 of a magnitude
    const double nearer = kMoonMeanKm / moon.distance_km, lit = 200 * moon.lit();
    const double share =
        exp2_of(-kTenth * (magnitude + 26.74)) * nearer * nearer * (lit < 1 ? lit : 1);
    return {1.100 * share, 0.988 * share, 0.830 * share};
}

}  // namespace pileus
