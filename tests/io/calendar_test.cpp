// SPDX-License-Identifier: Apache-2.0
// Dates and times as texts: each fault's line, days of every month, moments against published days.
// in: texts -> out: numbers, or what is wrong and what is allowed.
// docs/atmosphere.md
#include "src/scene/calendar.h"

#include <doctest/doctest.h>

namespace pileus {
namespace {

std::string date_fault(const std::string& text) {
    int ymd[3] = {};
    return read_date(text, ymd).message;
}

std::string time_fault(const std::string& text) {
    double hours = -1;
    return read_time(text, hours).message;
}

double hours_of(const std::string& text) {
    double hours = -1;
    CHECK(read_time(text, hours));
    return hours;
}

}  // namespace

TEST_CASE("calendar: every month has its days, and February its leap years") {
    const int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    for (int month = 1; month <= 12; ++month)
        for (const int year : {1900, 2000, 2023, 2024, 2100}) {
            const bool leap = year == 2000 || year == 2024;
            const int last = days[month - 1] + (month == 2 && leap ? 1 : 0);
            char text[48];
            std::snprintf(text, sizeof text, "%04d-%02d-%02d", year, month, last);
            int ymd[3] = {};
            CHECK(read_date(text, ymd));
            CHECK(ymd[0] == year);
            CHECK(ymd[1] == month);
            CHECK(ymd[2] == last);
            std::snprintf(text, sizeof text, "%04d-%02d-%02d", year, month, last + 1);
            CHECK(date_fault(text) ==
                  "no such day, allowed: 01 to " + std::to_string(last) + " in that month");
        }
}

TEST_CASE("calendar: what is no date says so") {
    for (const char* text : {"", "2026", "2026-06-2", "2026-06-211", "2026/06-21", "2026-06/21",
                             "2O26-06-21", "2026-0x-21", "2026-06-/1", "2026-06-:1"})
        CHECK(date_fault(text) == "no date, allowed: year-month-day, as \"2026-06-21\"");
    for (const char* text : {"1899-12-31", "2101-01-01"})
        CHECK(date_fault(text) == "out of range, allowed: years 1900 to 2100");
    for (const char* text : {"2026-00-01", "2026-13-01"})
        CHECK(date_fault(text) == "no such month, allowed: 01 to 12");
    CHECK(date_fault("2026-06-00") == "no such day, allowed: 01 to 30 in that month");
}

TEST_CASE("calendar: times of minutes, seconds and their parts") {
    CHECK(hours_of("00:00") == 0);
    CHECK(hours_of("14:30") == 14.5);
    CHECK(hours_of("14:30:36") == doctest::Approx(14.51).epsilon(1e-14));
    CHECK(hours_of("14:30:36.9") == doctest::Approx(14.51025).epsilon(1e-14));
    CHECK(hours_of("23:59:59.999999") < 24);
    for (const char* text :
         {"", "1430", "14.30", "x4:30", "14:3x", "14:3", "14:30:", "14:30 05", "14:30:0x",
          "14:30:05.", "14:30:05,5", "14:30:05.x", "14:30:05.1234567", "14:30:05.5/"})
        CHECK(time_fault(text) ==
              "no time, allowed: hours:minutes or hours:minutes:seconds, as \"14:30\" or "
              "\"14:30:05.5\"");
    for (const char* text : {"24:00", "23:60", "23:59:60"})
        CHECK(time_fault(text) == "no such time, allowed: 00:00 to 23:59:59.999999");
}

TEST_CASE("calendar: moments are the days that almanacs count") {
    // Meeus, "Astronomical Algorithms", chapter 7, the Gregorian ones among its examples.
    const struct {
        int ymd[3];
        double hours, day;
    } rows[] = {{{2000, 1, 1}, 12, 2451545.0}, {{1999, 1, 1}, 0, 2451179.5},
                {{1987, 1, 27}, 0, 2446822.5}, {{1987, 6, 19}, 12, 2446966.0},
                {{1988, 1, 27}, 0, 2447187.5}, {{1988, 6, 19}, 12, 2447332.0},
                {{1900, 1, 1}, 0, 2415020.5},  {{1957, 10, 4}, 19.44, 2436116.31}};
    for (const auto& row : rows)
        CHECK(moment_of(row.ymd, row.hours, 0).julian_day ==
              doctest::Approx(row.day).epsilon(1e-14));
    // A clock that is ahead shows later hours of the same moment.
    const int day[3] = {2026, 6, 21};
    CHECK(moment_of(day, 14, 2).julian_day == moment_of(day, 12, 0).julian_day);
}

}  // namespace pileus
