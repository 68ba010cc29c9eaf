// SPDX-License-Identifier: Apache-2.0
// See sun_position.h. Equations by their numbers in Reda & Andreas 2004; the periodic terms are
// theirs (VSOP87), those of at least 3e-7 radians.
#include "src/world/atmosphere/sun_position.h"

#include "src/world/atmosphere/earth_turn.h"

namespace pileus {
namespace {

constexpr double kDegrees = 57.295779513082320877;

struct Term {
    double size, phase, rate;
};
/// Earth's heliocentric longitude, 1e-8 radians by powers of millennia.
constexpr Term kLongitude0[] = {
    {175347046, 0, 0},           {3341656, 4.6692568, 6283.07585},
    {34894, 4.6261, 12566.1517}, {3497, 2.7441, 5753.3849},
    {3418, 2.8289, 3.5231},      {3136, 3.6277, 77713.7715},
    {2676, 4.4181, 7860.4194},   {2343, 6.1352, 3930.2097},
    {1324, 0.7425, 11506.7698},  {1273, 2.0371, 529.691},
    {1199, 1.1096, 1577.3435},   {990, 5.233, 5884.927},
    {902, 2.045, 26.298},        {857, 3.508, 398.149},
    {780, 1.179, 5223.694},      {753, 2.533, 5507.553},
    {505, 4.583, 18849.228},     {492, 4.205, 775.523},
    {357, 2.92, 0.067},          {317, 5.849, 11790.629},
    {284, 1.899, 796.298},       {271, 0.315, 10977.079},
    {243, 0.345, 5486.778},      {206, 4.806, 2544.314},
    {205, 1.869, 5573.143},      {202, 2.4458, 6069.777},
    {156, 0.833, 213.299},       {132, 3.411, 2942.463},
    {126, 1.083, 20.775},        {115, 0.645, 0.98},
    {103, 0.636, 4694.003},      {102, 0.976, 15720.839},
    {102, 4.267, 7.114},         {99, 6.21, 2146.17},
    {98, 0.68, 155.42},          {86, 5.98, 161000.69},
    {85, 1.3, 6275.96},          {85, 3.67, 71430.7},
    {80, 1.81, 17260.15},        {79, 3.04, 12036.46},
    {71, 1.76, 5088.63},         {74, 3.5, 3154.69},
    {74, 4.68, 801.82},          {70, 0.83, 9437.76},
    {62, 3.98, 8827.39},         {61, 1.82, 7084.9},
    {57, 2.78, 6286.6},          {56, 4.39, 14143.5},
    {56, 3.47, 6279.55},         {52, 0.19, 12139.55},
    {52, 1.33, 1748.02},         {51, 0.28, 5856.48},
    {49, 0.49, 1194.45},         {41, 5.37, 8429.24},
    {41, 2.4, 19651.05},         {39, 6.17, 10447.39},
    {37, 6.04, 10213.29},        {37, 2.57, 1059.38},
    {36, 1.71, 2352.87},         {36, 1.78, 6812.77},
    {33, 0.59, 17789.85},        {30, 0.44, 83996.85},
    {30, 2.74, 1349.87},
};
constexpr Term kLongitude1[] = {
    {628331966747.0, 0, 0},     {206059, 2.678235, 6283.07585},
    {4303, 2.6351, 12566.1517}, {425, 1.59, 3.523},
    {119, 5.796, 26.298},       {109, 2.966, 1577.344},
    {93, 2.59, 18849.23},       {72, 1.14, 529.69},
    {68, 1.87, 398.15},         {67, 4.41, 5507.55},
    {59, 2.89, 5223.69},        {56, 2.17, 155.42},
    {45, 0.4, 796.3},           {36, 0.47, 775.52},
};
constexpr Term kLongitude2[] = {{52919, 0, 0}, {8720, 1.0721, 6283.0758}, {309, 0.867, 12566.152}};
constexpr Term kLongitude3[] = {{289, 5.844, 6283.076}, {35, 0, 0}};
constexpr Term kLatitude0[] = {{280, 3.199, 84334.662},
                               {102, 5.422, 5507.553},
                               {80, 3.88, 5223.69},
                               {44, 3.7, 2352.87},
                               {32, 4, 1577.34}};
constexpr Term kRadius0[] = {
    {100013989, 0, 0},          {1670700, 3.0984635, 6283.07585}, {13956, 3.05525, 12566.1517},
    {3084, 5.1985, 77713.7715}, {1628, 1.1739, 5753.3849},        {1576, 2.8469, 7860.4194}};
constexpr Term kRadius1[] = {{103019, 1.10749, 6283.07585}, {1721, 1.0644, 12566.1517}};

template <std::size_t N>
double sum_of(const Term (&terms)[N], double millennia) {
    double sum = 0;
    // From the smallest on, so that the large ones keep their digits.
    for (std::size_t i = N; i-- > 0;)
        sum +=
            terms[i].size *
            sincos_deg(within_turn((terms[i].phase + terms[i].rate * millennia) * kDegrees)).cosine;
    return sum * 1e-8;
}

}  // namespace

SunPosition sun_position(const Moment& moment, double latitude_deg, double longitude_deg,
                         double height_m) {
    const double jd = moment.julian_day;
    const EarthTurn earth = earth_turn(jd);
    const double t = earth.centuries / 10;

    const double longitude =
        sum_of(kLongitude0, t) +
        t * (sum_of(kLongitude1, t) + t * (sum_of(kLongitude2, t) + t * sum_of(kLongitude3, t)));
    const double radius = sum_of(kRadius0, t) + t * sum_of(kRadius1, t);
    const double beta = -sum_of(kLatitude0, t) * kDegrees;

    const double obliquity = earth.obliquity_deg;
    // Eq. 26, 27: aberration.
    const double seen =
        within_turn(longitude * kDegrees + 180) + earth.nutation_deg - 20.4898 / (3600 * radius);

    // Eq. 28 to 31.
    const double right_ascension = angle_of_deg(
        sine(seen) * cosine(obliquity) - sine(beta) / cosine(beta) * sine(obliquity), cosine(seen));
    const double sine_declination =
        sine(beta) * cosine(obliquity) + cosine(beta) * sine(obliquity) * sine(seen);
    const double declination =
        angle_of_deg(sine_declination, __builtin_sqrt(1 - sine_declination * sine_declination));

    // Eq. 32 to 40: the observer is not in the earth's middle.
    const double hour = within_turn(earth.sidereal_deg + longitude_deg - right_ascension);
    const double parallax = 8.794 / (3600 * radius);
    const SineCosine at = sincos_deg(latitude_deg);
    const double reduced = angle_of_deg(0.99664719 * at.sine, at.cosine);
    const double x = cosine(reduced) + height_m / 6378140 * at.cosine;
    const double y = 0.99664719 * sine(reduced) + height_m / 6378140 * at.sine;
    const double px = sine(parallax);
    const double shift =
        angle_of_deg(-x * px * sine(hour), cosine(declination) - x * px * cosine(hour));
    const double lower = angle_of_deg((sine(declination) - y * px) * cosine(shift),
                                      cosine(declination) - x * px * cosine(hour));
    const double turned = hour - shift;

    // Eq. 41, 45, 46.
    SunPosition out;
    const double height = at.sine * sine(lower) + at.cosine * cosine(lower) * cosine(turned);
    const double held = height > 1 ? 1 : height < -1 ? -1 : height;
    out.elevation_deg = angle_of_deg(held, __builtin_sqrt(1 - held * held));
    out.azimuth_deg = within_turn(
        180 + angle_of_deg(sine(turned) * cosine(lower),
                           cosine(turned) * at.sine * cosine(lower) - sine(lower) * at.cosine));
    out.distance_au = radius;
    return out;
}

double refraction_deg(double elevation_deg, double pressure_hpa, double temperature_c) {
    double h = elevation_deg;
    if (h <= -3) return 0;
    const double fade = h < -1 ? (h + 3) / 2 : 1;
    if (h < -1) h = -1;
    const SineCosine at = sincos_deg(h + 10.3 / (h + 5.11));
    const double minutes = 1.02 * at.cosine / at.sine;
    const double bent = minutes / 60 * (pressure_hpa / 1010) * (283 / (273 + temperature_c));
    return bent > 0 ? fade * bent : 0;
}

}  // namespace pileus
