// SPDX-License-Identifier: Apache-2.0
// Dates and times as a scene writes them.
// in: text -> out: a moment of universal time; what is wrong with the text.
// docs/atmosphere.md
#pragma once
#include <cstdint>
#include <string>

#include "src/base/status.h"

namespace pileus {

/// A moment of universal time, as days since noon of 1 January 4713 BC.
struct Moment {
    double julian_day = 0;
};

/// From "2026-06-21" and "14:30" or "14:30:05.5", which are `utc_offset_h` hours ahead of universal
/// time. Years 1900 to 2100 of the Gregorian calendar. Errors: kBadInput, the texts without a key:
/// what is wrong, the value, what is allowed.
Status read_date(const std::string& date, int (&year_month_day)[3]);
Status read_time(const std::string& time, double& hours);
Moment moment_of(const int (&year_month_day)[3], double hours, double utc_offset_h);

// Days since 1970 of a date of the proleptic Gregorian calendar, below 0 before 1970. H. Hinnant,
// "chrono-Compatible Low-Level Date Algorithms".

inline std::int64_t days_from_civil(std::int64_t y, std::int64_t m, std::int64_t d) {
    y -= m <= 2 ? 1 : 0;
    const std::int64_t era = (y >= 0 ? y : y - 399) / 400;
    const std::int64_t yoe = y - era * 400;
    const std::int64_t doy = (153 * (m + (m > 2 ? -3 : 9)) + 2) / 5 + d - 1;
    return era * 146097 + yoe * 365 + yoe / 4 - yoe / 100 + doy - 719468;
}

}  // namespace pileus
