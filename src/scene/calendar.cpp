// SPDX-License-Identifier: Apache-2.0
// See calendar.h.
#include "src/scene/calendar.h"

namespace pileus {
namespace {

double whole_below(double x) {
    const double cut = double(static_cast<long long>(x));
    return cut > x ? cut - 1 : cut;
}

int days_in(int year, int month) {
    constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return month == 2 && leap ? 29 : kDays[month - 1];
}

/// Whether text[at, at + count) is digits; their number.
bool digits(const std::string& text, std::size_t at, std::size_t count, int& number) {
    number = 0;
    if (at + count > text.size()) return false;
    for (std::size_t i = at; i < at + count; ++i) {
        if (text[i] < '0' || text[i] > '9') return false;
        number = 10 * number + (text[i] - '0');
    }
    return true;
}

}  // namespace

Status read_date(const std::string& date, int (&ymd)[3]) {
    const bool shape = date.size() == 10 && date[4] == '-' && date[7] == '-' &&
                       digits(date, 0, 4, ymd[0]) && digits(date, 5, 2, ymd[1]) &&
                       digits(date, 8, 2, ymd[2]);
    if (!shape) return Status::bad_input("no date, allowed: year-month-day, as \"2026-06-21\"");
    if (ymd[0] < 1900 || ymd[0] > 2100)
        return Status::bad_input("out of range, allowed: years 1900 to 2100");
    if (ymd[1] < 1 || ymd[1] > 12) return Status::bad_input("no such month, allowed: 01 to 12");
    const int days = days_in(ymd[0], ymd[1]);
    if (ymd[2] < 1 || ymd[2] > days)
        return Status::bad_input("no such day, allowed: 01 to " + std::to_string(days) +
                                 " in that month");
    return Status::ok();
}

Status read_time(const std::string& time, double& hours) {
    const Status wrong = Status::bad_input(
        "no time, allowed: hours:minutes or hours:minutes:seconds, as \"14:30\" or \"14:30:05.5\"");
    int h = 0, m = 0, s = 0;
    if (time.size() < 5 || time[2] != ':' || !digits(time, 0, 2, h) || !digits(time, 3, 2, m))
        return wrong;
    double part = 0;
    if (time.size() > 5) {
        if (time[5] != ':' || !digits(time, 6, 2, s)) return wrong;
        if (time.size() > 8 && (time[8] != '.' || time.size() == 9 || time.size() > 15))
            return wrong;
        double digit = 0.1;
        for (std::size_t i = 9; i < time.size(); ++i, digit *= 0.1) {
            if (time[i] < '0' || time[i] > '9') return wrong;
            part += digit * (time[i] - '0');
        }
    }
    if (h > 23 || m > 59 || s > 59)
        return Status::bad_input("no such time, allowed: 00:00 to 23:59:59.999999");
    hours = h + m / 60.0 + (s + part) / 3600.0;
    return Status::ok();
}

Moment moment_of(const int (&ymd)[3], double hours, double utc_offset_h) {
    // Eq. 4, of the Gregorian calendar.
    int year = ymd[0], month = ymd[1];
    if (month < 3) year -= 1, month += 12;
    const int century = year / 100;
    const double days = whole_below(365.25 * (year + 4716)) + whole_below(30.6001 * (month + 1)) +
                        ymd[2] + (2 - century + century / 4) - 1524.5;
    return {days + (hours - utc_offset_h) / 24};
}

}  // namespace pileus
