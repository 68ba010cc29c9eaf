// SPDX-License-Identifier: Apache-2.0
// Dates and times as a scene writes them.
// in: text -> out: a moment of universal time; what is wrong with the text.
// docs/atmosphere.md
#pragma once
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

}  // namespace pileus
