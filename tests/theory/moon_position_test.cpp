// SPDX-License-Identifier: Apache-2.0
// Where the moon stands and how it is lit, against published positions, phases and eclipses.
// in: dates, times, places -> out: azimuth, elevation, distance, phase, light.
// Meeus 1998, examples 47.a, 48.a; NASA's catalogues of eclipses (Espenak & Meeus 2006).
#include "src/world/atmosphere/moon_position.h"

#include <doctest/doctest.h>

#include <cmath>

#include "src/world/atmosphere/earth_turn.h"
#include "src/world/atmosphere/sun_position.h"

using namespace pileus;

namespace {

Moment moment(const char* date, const char* time) {
    int ymd[3];
    double hours = 0;
    REQUIRE(read_date(date, ymd));
    REQUIRE(read_time(time, hours));
    return moment_of(ymd, hours, 0);
}

double apart_deg(const Double3& a, const Double3& b) {
    const double cosine = a.x * b.x + a.y * b.y + a.z * b.z;
    return std::acos(std::fmin(1, cosine)) * 57.29577951308232;
}

}  // namespace

TEST_CASE("moon position: the published example of 1992 April 12, 0 h TD") {
    const double centuries = (2448724.5 - 2451545) / 36525;
    const MoonPlace moon = moon_place(centuries);
    // Terms below 7e-4 degrees are left out: their squares add up to 0.002 degrees, and terms of
    // distance of up to 1.2 km each to some 4.
    CHECK(std::abs(moon.longitude_deg - 133.162655) < 0.005);
    CHECK(std::abs(moon.latitude_deg + 3.229126) < 0.004);
    CHECK(std::abs(moon.distance_km - 368409.7) < 15);
}

TEST_CASE("moon position: right ascension, declination and phase of the same date") {
    // 59 s of universal time earlier. At the place with the moon in its zenith no parallax is
    // left, the ellipsoid's vertical aside, and the distance is shorter by its radius.
    const Moment at{2448724.5 - 59.0 / 86400};
    const double sidereal = earth_turn(at.julian_day).sidereal_deg;
    const MoonPosition moon = moon_position(at, 13.768368, 134.688470 - within_turn(sidereal));
    // The vertical of latitude 13.8 misses the middle by 0.09 degrees, parallax makes of it 0.0015.
    CHECK(std::abs(moon.elevation_deg - 90) < 0.01);
    CHECK(std::abs(moon.distance_km - (368409.7 - 6377)) < 20);
    // Example 48.a has 69.0756 degrees and 0.6786, from the earth's middle: here 1 degree / 60
    // of parallax nearer at most, and the sun's own.
    CHECK(std::abs(moon.phase_deg - 69.0756) < 0.03);
    CHECK(std::abs(moon.lit() - 0.6786) < 3e-4);
}

TEST_CASE("moon position: it hides the sun where the sun was hidden") {
    struct Row {
        const char *date, *time;
        double latitude, longitude, sun_height;
    };
    // Places and times of greatest eclipse, where the shadow's axis passes. The catalogue's places
    // are told to 0.1 degrees of the earth (0.002 degrees of the moon's way) and 1 s, the moon's
    // longitude is good to 0.005 degrees: 0.01 degrees for all (0.002 are found). Without parallax
    // the moon would stand 0.3 to 0.9 degrees away.
    for (const Row& row : {Row{"1999-08-11", "11:03:05", 45.1, 24.3, 59},
                           Row{"2017-08-21", "18:25:32", 37.0, -87.7, 64},
                           Row{"2024-04-08", "18:17:18", 25.3, -104.1, 70}}) {
        const Moment at = moment(row.date, row.time);
        const MoonPosition moon = moon_position(at, row.latitude, row.longitude);
        const SunPosition sun = sun_position(at, row.latitude, row.longitude);
        CAPTURE(row.date);
        // Tells that the row is right; told to whole degrees.
        CHECK(std::abs(sun.elevation_deg - row.sun_height) < 0.6);
        const double apart = apart_deg(towards_deg(moon.azimuth_deg, moon.elevation_deg),
                                       towards_deg(sun.azimuth_deg, sun.elevation_deg));
        CHECK(apart < 0.01);
        CHECK(moon.phase_deg > 179);
        CHECK(moon.lit() < 1e-4);
    }
}

TEST_CASE("moon position: full in an eclipse, half at a quarter") {
    // 2000 January 21, 4:44, eclipsed where the moon stood over 66 W: 0.28 degrees off the axis of
    // the shadow, as seen from the earth's middle, parallax at most 0.02 where it stands high.
    const MoonPosition full = moon_position(moment("2000-01-21", "04:43:30"), 20, -66);
    CHECK(full.phase_deg < 0.6);
    CHECK(full.elevation_deg > 80);
    CHECK(full.lit() > 0.9999);
    // First quarter by longitude on January 14 at 13:34: a quarter seen from the earth is not one
    // seen from the sun by 0.15 degrees, latitudes by another 0.1, parallax by 1.
    const MoonPosition half = moon_position(moment("2000-01-14", "13:34"), 0, 0);
    CHECK(std::abs(half.lit() - 0.5) < 0.012);
}

TEST_CASE("moon position: light by phase") {
    MoonPosition moon;
    moon.distance_km = kMoonMeanKm;
    const auto bright = [&](double phase) {
        moon.phase_deg = phase;
        moon.cosine_of_phase = cosine(phase);
        const std::array<double, 3> light = moon_light(moon);
        return 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
    };
    // 14.01 magnitudes below the sun; the colours' luminance is 1 within their three digits.
    CHECK(bright(0) == doctest::Approx(std::pow(10, -0.4 * 14.01)).epsilon(1e-3));
    // Allen 1976: 2.6 magnitudes at 90 degrees less, an eleventh of the light.
    CHECK(bright(90) / bright(0) ==
          doctest::Approx(std::pow(10, -0.4 * (0.026 * 90 + 0.26244))).epsilon(1e-9));
    CHECK(bright(180) == 0);
    double before = bright(0);
    for (int phase = 1; phase <= 180; ++phase) {
        const double now = bright(phase);
        CHECK(now < before);
        before = now;
    }
    moon.distance_km = 2 * kMoonMeanKm;
    CHECK(bright(0) == doctest::Approx(0.25 * std::pow(10, -0.4 * 14.01)).epsilon(1e-3));
}

TEST_CASE("moon position: poles, both ends of the years, a whole month") {
    for (const double latitude : {-90.0, 0.0, 90.0})
        for (const char* date : {"1900-01-01", "2000-02-29", "2100-12-31"})
            for (int hour = 0; hour < 24 * 28; hour += 7) {
                Moment at = moment(date, "00:00");
                at.julian_day += hour / 24.0;
                const MoonPosition moon = moon_position(at, latitude, 17);
                CHECK(moon.azimuth_deg >= 0);
                CHECK(moon.azimuth_deg < 360);
                // Perigees and apogees of five centuries, less the earth's radius (Meeus, 50).
                CHECK(moon.distance_km > 356375 - 6400);
                CHECK(moon.distance_km < 406725 + 6400);
                // At a pole the elevation is the declination, of 28.7 degrees at most, and
                // parallax.
                CHECK(std::abs(moon.elevation_deg) <= (latitude == 0 ? 90.0 : 30.0));
                CHECK(std::abs(moon.to_sun.x * moon.to_sun.x + moon.to_sun.y * moon.to_sun.y +
                               moon.to_sun.z * moon.to_sun.z - 1) < 1e-12);
            }
}
