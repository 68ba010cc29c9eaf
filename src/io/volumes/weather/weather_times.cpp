// SPDX-License-Identifier: Apache-2.0
// Dates of a file's times.
// in: the variable `Times` of WRF, or a coordinate in units since a date -> out: ISO texts.
// CF conventions 1.10, section 4.4; Howard Hinnant, "chrono-compatible low-level date algorithms".
#include <charconv>

#include "src/io/netcdf/netcdf_values.h"
#include "src/io/volumes/weather/weather_axes.h"
#include "src/scene/calendar.h"

namespace pileus {
namespace {

constexpr std::uint64_t kMostTimes = 100'000;

std::string digits(std::int64_t value, std::size_t width) {
    std::string text = std::to_string(value);
    while (text.size() < width) text.insert(text.begin(), '0');
    return text;
}

/// The next whole number of a text and what stands behind it.
bool next_number(const char*& at, const char* end, std::int64_t& value) {
    while (at < end && (*at < '0' || *at > '9')) ++at;
    const auto read = std::from_chars(at, end, value);
    at = read.ptr;
    return read.ec == std::errc() && value < 1'000'000;
}

/// "hours since 2005-08-28 00:00:00": seconds per unit, and of the date.
bool parse_since(const std::string& units, double& step, std::int64_t& start) {
    const std::size_t since = units.find(" since ");
    if (since == std::string::npos) return false;
    const std::string unit = units.substr(0, since);
    const auto is = [&](const char* name) {
        return unit == name || unit == std::string(name) + "s";
    };
    if (is("second") || unit == "s" || is("sec"))
        step = 1;
    else if (is("minute") || is("min"))
        step = 60;
    else if (is("hour") || unit == "h" || is("hr"))
        step = 3600;
    else if (is("day") || unit == "d")
        step = 86400;
    else
        return false;
    const char* at = units.data() + since + 7;
    const char* end = units.data() + units.size();
    std::int64_t part[6] = {0, 1, 1, 0, 0, 0};
    for (int i = 0; i < 6; ++i)
        if (!next_number(at, end, part[i])) {
            if (i < 3) return false;
            part[i] = 0;
            break;
        }
    if (part[1] < 1 || part[1] > 12 || part[2] < 1 || part[2] > 31) return false;
    start = days_from_civil(part[0], part[1], part[2]) * 86400 + part[3] * 3600 + part[4] * 60 +
            part[5];
    return true;
}

/// Rows of characters, one for each time.
Status read_date_rows(const NcFile& file, const NcVariable& v, std::vector<std::string>& dates) {
    const NcBlock block = whole_block(file.head(), v);
    if (block.values() > kMostTimes * 64) return Status::ok();
    std::vector<double> letters(std::size_t(block.values()));
    PILEUS_TRY(file.read(v, block, {letters.data(), letters.size()}));
    const std::size_t length = std::size_t(block.count[1]);
    for (std::size_t i = 0; i < block.count[0]; ++i) {
        std::string date;
        for (std::size_t k = 0; k < length; ++k) {
            const char c = nc_letter(letters[i * length + k]);
            if (c != '\0') date += c == '_' || c == ' ' ? 'T' : c;
        }
        dates.push_back(printable_line(date));
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

Status weather_times(const NcFile& file, std::size_t dimension, std::vector<std::string>& dates) {
    const NcHead& head = file.head();
    const std::uint64_t size = head.dimensions[dimension].size;
    dates.clear();
    if (size > kMostTimes) return Status::ok();
    if (const NcVariable* v = head.find("Times"))
        if (v->type == NcType::kChar && v->dimensions.size() == 2 &&
            v->dimensions[0] == dimension && head.size(*v, 1) <= 64)
            return read_date_rows(file, *v, dates);
    const NcVariable* v = head.find(head.dimensions[dimension].name);
    double step = 0;
    std::int64_t start = 0;
    if (v == nullptr || v->dimensions.size() != 1 || v->dimensions[0] != dimension ||
        v->type == NcType::kChar || !parse_since(v->text("units"), step, start))
        return Status::ok();
    const std::string calendar = v->text("calendar");
    if (!calendar.empty() && calendar != "standard" && calendar != "gregorian" &&
        calendar != "proleptic_gregorian")
        return Status::ok();
    std::vector<double> values(std::size_t(size), 0.0);
    PILEUS_TRY(file.read(*v, whole_block(head, *v), {values.data(), values.size()}));
    for (const double value : values) {
        const double seconds = value * step;
        if (!(seconds > -1e12 && seconds < 1e12)) {
            dates.clear();
            return Status::ok();
        }
        dates.push_back(date_text(start + std::int64_t(seconds + (seconds < 0 ? -0.5 : 0.5))));
    }
    return Status::ok();
}

}  // namespace pileus
