// SPDX-License-Identifier: Apache-2.0
// Dates of a file's times.
// in: the variable `Times` of WRF, or a coordinate in units since a date -> out: ISO texts.
// CF conventions 1.10, section 4.4; Howard Hinnant, "chrono-compatible low-level date algorithms".

#include "src/base/number_text.h"
#include "src/io/netcdf/netcdf_packing.h"
#include "src/io/netcdf/netcdf_values.h"
#include "src/io/volumes/weather/weather_axes.h"
#include "src/scene/calendar.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

constexpr std::uint64_t kMaxTimes = 100'000;

/// "2005-08-28 12" and "2005-08-28_12" are "2005-08-28T12".
std::string date_form(std::string text) {
    for (char& c : text)
        if (c == '_' || c == ' ') c = 'T';
    if (!text.empty() && text.back() == 'Z') text.pop_back();
    return text;
}

bool whole_number(const std::string& text, std::uint64_t& value) {
    const char* end = text.data() + text.size();
    const auto read = number_from(text.data(), end, value);
    return read.ec == std::errc() && read.ptr == end;
}

std::string digits(std::int64_t value, std::size_t width) {
    std::string text = std::to_string(value);
    while (text.size() < width) text.insert(text.begin(), '0');
    return text;
}

/// Days since 1970 of the Julian calendar.
std::int64_t days_from_julian(std::int64_t year, std::int64_t month, std::int64_t day) {
    const std::int64_t a = (14 - month) / 12, y = year + 4800 - a, m = month + 12 * a - 3;
    return day + (153 * m + 2) / 5 + 365 * y + y / 4 - 32083 - 2440588;
}

/// Walks along "2005-08-28 06:30:15.5 +02:00".
class DateReader {
public:
    explicit DateReader(const std::string& text)
        : at_(text.data()), end_(text.data() + text.size()) {}

    /// False where anything is left that is no date. `mixed`: Julian before 15 October 1582.
    bool read(bool mixed, double& seconds) {
        std::int64_t year = 0, month = 0, day = 0;
        skip();
        if (!whole(year) || !mark('-') || !whole(month) || !mark('-') || !whole(day)) return false;
        if (month < 1 || month > 12 || day < 1 || day > 31) return false;
        const bool early =
            year < 1582 || (year == 1582 && (month < 10 || (month == 10 && day < 15)));
        const std::int64_t days =
            mixed && early ? days_from_julian(year, month, day) : days_from_civil(year, month, day);
        double clock = 0, zone = 0;
        if (at_ < end_ && (*at_ == 'T' || *at_ == ' ' || *at_ == '_')) {
            ++at_;
            skip();
            const bool given = at_ < end_ && *at_ >= '0' && *at_ <= '9';
            if (given && !time(clock)) return false;
        }
        skip();
        if (!zone_of(zone)) return false;
        skip();
        seconds = double(days) * 86400 + clock - zone;
        return at_ == end_;
    }

private:
    void skip() {
        while (at_ < end_ && *at_ == ' ') ++at_;
    }
    bool mark(char c) {
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }
    bool whole(std::int64_t& value) {
        if (at_ == end_ || *at_ < '0' || *at_ > '9') return false;
        const auto read = number_from(at_, end_, value);
        at_ = read.ptr;
        return read.ec == std::errc() && value < 1'000'000;
    }
    /// "06", "06:30", "06:30:15.5".
    bool time(double& seconds) {
        std::int64_t hour = 0, minute = 0;
        double second = 0;
        if (!whole(hour)) return false;
        if (mark(':')) {
            if (!whole(minute)) return false;
            if (mark(':')) {
                const auto read = number_from(at_, end_, second, std::chars_format::fixed);
                if (read.ec != std::errc()) return false;
                at_ = read.ptr;
            }
        }
        seconds = double(hour) * 3600 + double(minute) * 60 + second;
        return hour <= 24 && minute < 60 && second >= 0 && second < 61;
    }
    /// "", "Z", "UTC", "GMT", "+02:00", "-0330", "+2".
    bool zone_of(double& seconds) {
        const std::string rest(at_, end_);
        for (const char* name : {"Z", "UTC", "GMT"})
            if (rest.compare(0, std::string(name).size(), name) == 0) {
                at_ += std::string(name).size();
                return true;
            }
        const bool west = mark('-');
        if (!west && !mark('+')) return true;
        const char* from = at_;
        std::int64_t hour = 0, minute = 0;
        if (!whole(hour)) return false;
        if (at_ - from > 2) {
            minute = hour % 100;
            hour /= 100;
        } else if (mark(':') && !whole(minute)) {
            return false;
        }
        seconds = (double(hour) * 3600 + double(minute) * 60) * (west ? -1 : 1);
        return hour <= 14 && minute < 60;
    }

    const char* at_;
    const char* end_;
};

/// "hours since 2005-08-28 00:00:00": seconds per unit, and of the date.
bool parse_since(const std::string& units, bool mixed, double& step, double& start) {
    const std::size_t since = units.find(" since ");
    if (since == std::string::npos) return false;
    const std::string unit = units.substr(0, since);
    const auto is = [&](const char* name) {
        return unit == name || unit == std::string(name) + "s";
    };
    if (is("second") || unit == "s" || is("sec"))
        step = 1;
    else if (is("millisecond") || unit == "ms" || is("msec"))
        step = 1e-3;
    else if (is("minute") || is("min"))
        step = 60;
    else if (is("hour") || unit == "h" || is("hr"))
        step = 3600;
    else if (is("day") || unit == "d")
        step = 86400;
    else
        return false;
    return DateReader(units.substr(since + 7)).read(mixed, start);
}

/// Dates of letters, one for each time.
Status read_date_rows(const NcFile& file, const NcVariable& v, std::vector<std::string>& dates) {
    PILEUS_TRY(read_letter_rows(file, v, kMaxTimes, dates));
    for (std::string& date : dates) {
        for (char& c : date)
            if (c == '_' || c == ' ') c = 'T';
        date = printable_line(date);
    }
    return Status::ok();
}

}  // namespace

std::string date_text(std::int64_t seconds) {
    std::int64_t days = seconds / 86400, rest = seconds % 86400;
    if (rest < 0) {
        rest += 86400;
        --days;
    }
    const std::int64_t z = days + 719468, era = (z >= 0 ? z : z - 146096) / 146097;
    const std::int64_t doe = z - era * 146097;
    const std::int64_t yoe = (doe - doe / 1460 + doe / 36524 - doe / 146096) / 365;
    const std::int64_t doy = doe - (365 * yoe + yoe / 4 - yoe / 100);
    const std::int64_t mp = (5 * doy + 2) / 153;
    const std::int64_t month = mp < 10 ? mp + 3 : mp - 9;
    const std::int64_t year = yoe + era * 400 + (month <= 2 ? 1 : 0);
    return digits(year, 4) + '-' + digits(month, 2) + '-' +
           digits(doy - (153 * mp + 2) / 5 + 1, 2) + 'T' + digits(rest / 3600, 2) + ':' +
           digits(rest / 60 % 60, 2) + ':' + digits(rest % 60, 2);
}

Status weather_times(const NcFile& file, std::size_t dimension, std::vector<std::string>& dates,
                     std::string& why) {
    const NcHead& head = file.head();
    const std::uint64_t size = head.dimensions[dimension].size;
    dates.clear();
    why.clear();
    if (size > kMaxTimes) return Status::ok();
    if (const NcVariable* v = head.find("Times"))
        if (v->type == NcType::kChar && v->dimensions.size() == 2 &&
            v->dimensions[0] == dimension && head.size(*v, 1) <= 64)
            return read_date_rows(file, *v, dates);
    const NcVariable* v = nullptr;
    for (const NcVariable* c : coordinates_of(head, dimension, AxisKind::kTime))
        if (v == nullptr && c->text("units").find(" since ") != std::string::npos) v = c;
    if (v == nullptr) return Status::ok();
    const std::string calendar = v->text("calendar"), units = v->text("units");
    const bool mixed = calendar.empty() || calendar == "standard" || calendar == "gregorian";
    double step = 0, start = 0;
    if (!mixed && calendar != "proleptic_gregorian")
        why = "calendar " + quote_text(calendar);
    else if (!parse_since(units, mixed, step, start))
        why = "units " + quote_text(units);
    if (!why.empty()) return Status::ok();
    std::vector<double> values(std::size_t(size), 0.0);
    PILEUS_TRY(read_unpacked(file, *v, whole_block(head, *v), {values.data(), values.size()}));
    for (const double value : values) {
        const double seconds = start + value * step;
        if (!(seconds > -1e12 && seconds < 1e12)) {
            dates.clear();
            why = "its values";
            return Status::ok();
        }
        dates.push_back(date_text(std::int64_t(seconds + (seconds < 0 ? -0.5 : 0.5))));
    }
    return Status::ok();
}

Status choose_time(const NcFile& file, const WeatherChoice& wanted, WeatherAxes& axes) {
    std::vector<std::string> dates;
    std::string why;
    PILEUS_TRY(weather_times(file, axes.time, dates, why));
    const std::uint64_t size = file.head().dimensions[axes.time].size;
    const auto fault = [&](const std::string& line) {
        std::string allowed = "0 to " + std::to_string(size - 1);
        if (!dates.empty())
            allowed +=
                " or the beginning of one date from " + dates.front() + " to " + dates.back();
        if (!why.empty()) allowed += "; of its dates this is not understood: " + why;
        return Status::bad_input(file.name() +
                                 ": time: " + printable_line(line + ", allowed: " + allowed));
    };
    axes.time_index = std::uint64_t(wanted.index);
    if (wanted.by_name) {
        const std::string start = date_form(wanted.name);
        std::size_t hits = 0;
        for (std::size_t i = 0; i < dates.size(); ++i)
            if (dates[i].compare(0, start.size(), start) == 0) {
                axes.time_index = i;
                ++hits;
            }
        // Shorter than any year: an index.
        std::uint64_t index = 0;
        if (start.size() < 4 && whole_number(start, index)) {
            axes.time_index = index;
            hits = 1;
        }
        if (hits != 1)
            return fault((hits == 0 ? "not in the file, " : "several in the file, ") +
                         quote_text(wanted.name));
    }
    if (axes.time_index >= size)
        return fault("not in the file, " +
                     (wanted.by_name ? wanted.name : std::to_string(wanted.index)));
    if (axes.time_index < dates.size()) axes.time_text = dates[std::size_t(axes.time_index)];
    return Status::ok();
}

}  // namespace pileus
