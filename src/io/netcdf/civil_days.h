// SPDX-License-Identifier: Apache-2.0
// Days since 1970 of a date of the proleptic Gregorian calendar.
// in: year, month, day -> out: a whole number, below 0 before 1970.
// H. Hinnant, "chrono-Compatible Low-Level Date Algorithms"
#pragma once
#include <cstdint>

namespace pileus {

inline std::int64_t days_from_civil(std::int64_t y, std::int64_t m, std::int64_t d) {
    y -= m <= 2 ? 1 : 0;
    const std::int64_t era = (y >= 0 ? y : y - 399) / 400;
    const std::int64_t yoe = y - era * 400;
    const std::int64_t doy = (153 * (m + (m > 2 ? -3 : 9)) + 2) / 5 + d - 1;
    return era * 146097 + yoe * 365 + yoe / 4 - yoe / 100 + doy - 719468;
}

}  // namespace pileus
