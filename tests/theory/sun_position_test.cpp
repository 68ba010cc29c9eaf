// SPDX-License-Identifier: Apache-2.0
// Where the sun stands, against published positions.
// in: dates, times, places -> out: azimuth, elevation; faults of texts.
// Reda & Andreas 2004, appendix A.5; Meeus 1998, example 25.b.
#include "src/world/atmosphere/sun_position.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace pileus;

namespace {

constexpr double kDegree = 0.017453292519943295;

Moment moment(const char* date, const char* time, double offset = 0) {
    int ymd[3];
    double hours = 0;
    REQUIRE(read_date(date, ymd));
    REQUIRE(read_time(time, hours));
    return moment_of(ymd, hours, offset);
}

}  // namespace

TEST_CASE("sun position: the example of the published algorithm") {
    const Moment at = moment("2003-10-17", "12:30:30", -7);
    CHECK(at.julian_day == doctest::Approx(2452930.312847).epsilon(1e-12));
    const SunPosition sun = sun_position(at, 39.742476, -105.1786, 1830.14);
    // 0.01 degrees are asked; the terms left out cost 2e-5.
    CHECK(std::abs(sun.azimuth_deg - 194.340241) < 1e-4);
    CHECK(std::abs(sun.elevation_deg - 39.872046) < 1e-4);
    CHECK(std::abs(refraction_deg(39.872046, 820, 11) - 0.016332) < 1e-6);
    // A few of the smaller terms of the distance are left out.
    CHECK(std::abs(sun.distance_au - 0.9965422974) < 2e-5);
}

TEST_CASE("sun position: right ascension and declination of 1992 October 13, 0 h TD") {
    // 59.2 s of universal time earlier.
    const Moment at{2448908.5 - 59.2 / 86400};
    const double right_ascension = 198.378178, declination = -7.783871;
    const double centuries = (at.julian_day - 2451545) / 36525;
    const double sidereal = 280.46061837 + 360.98564736629 * (at.julian_day - 2451545) +
                            0.000387933 * centuries * centuries + 0.00399;  // with nutation
    for (const double latitude : {-60.0, 0.0, 51.5}) {
        const double hour = (sidereal + 30 - right_ascension) * kDegree;
        const double d = declination * kDegree, l = latitude * kDegree;
        const double height =
            std::asin(std::sin(l) * std::sin(d) + std::cos(l) * std::cos(d) * std::cos(hour)) /
            kDegree;
        // The observer's place on the earth moves the sun by up to 0.0024 degrees.
        CHECK(std::abs(sun_position(at, latitude, 30).elevation_deg - height) < 0.004);
    }
}

TEST_CASE("sun position: seasons, poles, both ends of the years") {
    // At the poles the elevation is the declination, 23.436 degrees at that solstice, and the
    // parallax lowers it by 0.0022; the time is known to a minute.
    CHECK(std::abs(sun_position(moment("2026-06-21", "08:24"), 90, 0).elevation_deg - 23.436) <
          0.005);
    CHECK(std::abs(sun_position(moment("2026-06-21", "08:24"), -90, 0).elevation_deg + 23.436) <
          0.005);
    // The equinox of 2026 is on March 20 at 14:46.
    CHECK(std::abs(sun_position(moment("2026-03-20", "14:46"), 90, 0).elevation_deg) < 0.005);
    for (const char* date : {"1900-01-01", "1950-07-04", "2000-02-29", "2050-12-31", "2100-12-31"})
        for (double longitude = -180; longitude <= 180; longitude += 45) {
            const SunPosition sun = sun_position(moment(date, "00:00"), 0, longitude);
            CHECK(sun.azimuth_deg >= 0);
            CHECK(sun.azimuth_deg < 360);
            CHECK(std::abs(sun.elevation_deg) <= 90);
            CHECK(std::abs(sun.distance_au - 1) < 0.018);
        }
}

TEST_CASE("sun position: texts that are no date or time") {
    int ymd[3];
    double hours = 0;
    for (const char* date :
         {"", "2026-6-21", "2026-13-01", "2026-00-10", "2026-02-29", "2100-02-29", "2026-04-31",
          "1899-12-31", "2101-01-01", "2026-06-210", "2026/06/21", "20x6-06-21"})
        CHECK_FALSE(read_date(date, ymd));
    CHECK(read_date("2000-02-29", ymd));
    for (const char* time : {"", "7:30", "24:00", "12:60", "12:30:60", "12-30", "12:30:", "12:30:5",
                             "12:30:05.", "12:30:05.1234567", "12:30:05,5"})
        CHECK_FALSE(read_time(time, hours));
    REQUIRE(read_time("23:59:59.5", hours));
    CHECK(hours == doctest::Approx(24 - 0.5 / 3600).epsilon(1e-12));
}

TEST_CASE("sun position: angles of vectors") {
    for (double degrees = -180; degrees <= 180; degrees += 0.37) {
        const double x = 3 * std::cos(degrees * kDegree), y = 3 * std::sin(degrees * kDegree);
        CHECK(std::abs(angle_of_deg(y, x) - std::atan2(y, x) / kDegree) < 1e-12);
    }
    CHECK(angle_of_deg(0, 0) == 0);
    CHECK(angle_of_deg(1, 0) == 90);
    CHECK(angle_of_deg(0, 1) == 0);
}
