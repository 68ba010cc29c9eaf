// SPDX-License-Identifier: Apache-2.0
// Groups of a METAR that have numbers: time, wind, visibility, clouds, temperature, pressure.
// in: a word -> out: its values in SI units.
// ICAO Annex 3, Appendix 3; FMH-1, chapter 12. docs/metar.md
#include "src/scene/metar/metar_groups.h"

#include "src/base/printable.h"

namespace pileus {
namespace {

constexpr double kKnot = 1852.0 / 3600;  // m/s
constexpr double kMile_m = 1609.344;     // statute
constexpr double kHundredFeet_m = 30.48;
constexpr double kInch_hpa = 33.8638866667;  // of mercury

constexpr double kMaxSpeed_m_per_s = 150;  // above all winds on record, 113 m/s

/// 0 to 360 in steps of one degree; the code's tens are not asked for, as stations give both.
bool direction_fits(int degrees) { return degrees <= 360; }

bool take_speed(MetarCursor& at, int& speed) {
    at.take("P");  // "more than": P49MPS, P99KT
    return at.take_digits(2, 3, speed);
}

/// N, NE ... of a visibility; empty: none.
std::string_view take_towards(MetarCursor& at) {
    for (const std::string_view towards : {"NE", "NW", "SE", "SW", "N", "E", "S", "W"})
        if (at.rest() == towards) {
            at.take(towards);
            return towards;
        }
    return {};
}

/// Miles as FMH-1 writes them: 10SM, 1/2SM, M1/4SM, P6SM; `whole` stood before a fraction.
MetarForm read_miles(std::string_view word, int whole, MetarVisibility& out, Status& fault) {
    MetarCursor at(word);
    const bool less = at.take("M"), more = !less && at.take("P");
    int number = 0, parts = 1;
    if (!at.take_digits(1, 2, number)) return MetarForm::kOther;
    const bool fraction = at.take("/");
    if (fraction && !at.take_digits(1, 2, parts)) return MetarForm::kOther;
    if (!at.take("SM") || !at.at_end() || (whole > 0 && (!fraction || less || more)))
        return MetarForm::kOther;
    const bool known = parts == 2 || parts == 4 || parts == 8 || parts == 16;
    if (fraction && (!known || number == 0 || number >= parts)) {
        fault = metar_fault("no fraction of a mile", word, "n/2, n/4, n/8 or n/16 below 1");
        return MetarForm::kFault;
    }
    out.given = true;
    out.m = (whole + double(number) / parts) * kMile_m;
    // Automatic stations end at 10 miles: that is "10 or more" (FMH-1, 12.6.6).
    const bool most = !fraction && number == 10;
    // 0 is less than the least other value, a sixteenth.
    const bool none = !fraction && number == 0;
    if (none) out.m = kMile_m / 16;
    out.bound = less || none   ? MetarBound::kLess
                : more || most ? MetarBound::kMore
                               : MetarBound::kExact;
    return MetarForm::kRead;
}

bool take_temperature(MetarCursor& at, bool& given, double& celsius) {
    if (at.take_strokes(2) || at.take("XX")) return true;
    const bool below = at.take("M");
    int number = 0;
    if (!at.take_digits(2, 2, number)) return false;
    given = true;
    celsius = below ? -number : number;
    return true;
}

}  // namespace

Status metar_fault(std::string_view what, std::string_view word, std::string_view allowed) {
    return Status::bad_input("metar: " + std::string(what) + ", \"" + printable(word, 40, "...") +
                             "\", allowed: " + std::string(allowed));
}

MetarForm read_metar_time(std::string_view word, Metar& out, Status& fault) {
    if (word.size() != 7 || word[6] != 'Z') return MetarForm::kOther;
    int number = 0;
    if (!MetarCursor(word.substr(0, 6)).take_digits(6, 6, number)) return MetarForm::kOther;
    const int day = number / 10000, hour = number / 100 % 100, minute = number % 100;
    if (day < 1 || day > 31 || hour > 23 || minute > 59) {
        fault = metar_fault("no such day or time", word, "days 01 to 31, 0000Z to 2359Z");
        return MetarForm::kFault;
    }
    out.time_given = true;
    out.day = day, out.hour = hour, out.minute = minute;
    return MetarForm::kRead;
}

MetarForm read_metar_wind(std::string_view word, MetarWind& out, Status& fault) {
    MetarCursor at(word);
    MetarWind wind;
    int degrees = 0, speed = 0, gust = 0;
    const bool no_direction = at.take_strokes(3);
    wind.variable = !no_direction && at.take("VRB");
    if (!no_direction && !wind.variable && !at.take_digits(3, 3, degrees)) {
        // A speed of three digits makes one run of six.
        MetarCursor six(word);
        if (!six.take_digits(5, 6, degrees)) return MetarForm::kOther;
        const std::size_t run = word.size() - six.rest().size();
        at = MetarCursor(word.substr(3));
        degrees /= run == 5 ? 100 : 1000;
    }
    const bool no_speed = at.take_strokes(2);
    if (no_speed) at.take_strokes(1);
    if (!no_speed && !take_speed(at, speed)) return MetarForm::kOther;
    if (at.take("G") && !at.take_strokes(2) && !take_speed(at, gust)) return MetarForm::kOther;
    double unit = 0;
    if (at.take("KT"))
        unit = kKnot;
    else if (at.take("MPS"))
        unit = 1;
    else if (at.take("KMH"))
        unit = 1 / 3.6;
    if (!(unit > 0) || !at.at_end()) return MetarForm::kOther;
    if (!direction_fits(degrees)) {
        fault = metar_fault("wind direction out of range", word, "000 to 360");
        return MetarForm::kFault;
    }
    wind.given = !no_direction && !no_speed;
    wind.from_deg = degrees;
    wind.speed_m_per_s = speed * unit;
    wind.gust_m_per_s = gust * unit;
    if (wind.speed_m_per_s > kMaxSpeed_m_per_s || wind.gust_m_per_s > kMaxSpeed_m_per_s) {
        fault = metar_fault("wind speed out of range", word, "up to 150 m/s");
        return MetarForm::kFault;
    }
    out = wind;
    return MetarForm::kRead;
}

MetarForm read_metar_sector(std::string_view word, MetarWind& out, Status& fault) {
    MetarCursor at(word);
    int from = 0, to = 0;
    if (!at.take_digits(3, 3, from) || !at.take("V") || !at.take_digits(3, 3, to) || !at.at_end())
        return MetarForm::kOther;
    if (!direction_fits(from) || !direction_fits(to)) {
        fault = metar_fault("wind direction out of range", word, "000 to 360");
        return MetarForm::kFault;
    }
    out.sector_from_deg = from;
    out.sector_to_deg = to;
    return MetarForm::kRead;
}

MetarForm read_metar_visibility(std::string_view word, int whole, MetarVisibility& out,
                                Status& fault) {
    if (word.size() > 2 && word.substr(word.size() - 2) == "SM")
        return read_miles(word, whole, out, fault);
    MetarCursor at(word);
    int metres = 0;
    if (whole > 0 || !at.take_digits(4, 4, metres)) return MetarForm::kOther;
    const bool no_directions = at.take("NDV");
    const std::string_view towards = no_directions ? std::string_view() : take_towards(at);
    if (!at.at_end()) return MetarForm::kOther;
    if (!towards.empty() && out.given) {
        // A second, lesser one towards some side; of several the least.
        if (!out.least_towards.empty() && out.least_m <= metres) return MetarForm::kRead;
        out.least_m = metres;
        out.least_towards = towards;
        return MetarForm::kRead;
    }
    if (out.given) return MetarForm::kOther;
    out.given = true;
    out.no_directions = no_directions;
    // 9999: 10 km or more, 0000: below 50 m (Annex 3, Appendix 3, 4.2.4).
    out.m = metres == 9999 ? 10000 : metres == 0 ? 50 : metres;
    if (metres == 9999) out.bound = MetarBound::kMore;
    if (metres == 0) out.bound = MetarBound::kLess;
    return MetarForm::kRead;
}

MetarForm read_metar_cloud(std::string_view word, Metar& out) {
    MetarCursor at(word);
    int hundreds = 0;
    if (at.take("VV")) {
        const bool unknown = at.take_strokes(3);
        if ((!unknown && !at.take_digits(3, 3, hundreds)) || !at.at_end()) return MetarForm::kOther;
        out.obscured = true;
        out.vertical_visibility_given = !unknown;
        out.vertical_visibility_m = hundreds * kHundredFeet_m;
        return MetarForm::kRead;
    }
    MetarCloud cloud;
    if (at.take("FEW"))
        cloud.cover = MetarCover::kFew;
    else if (at.take("SCT"))
        cloud.cover = MetarCover::kScattered;
    else if (at.take("BKN"))
        cloud.cover = MetarCover::kBroken;
    else if (at.take("OVC"))
        cloud.cover = MetarCover::kOvercast;
    else if (!at.take_strokes(3))
        return MetarForm::kOther;
    cloud.height_given = !at.take_strokes(3);
    if (cloud.height_given && !at.take_digits(3, 3, hundreds)) return MetarForm::kOther;
    cloud.height_m = hundreds * kHundredFeet_m;
    if (at.take("CB"))
        cloud.tower = MetarTower::kCumulonimbus;
    else if (at.take("TCU"))
        cloud.tower = MetarTower::kCongestus;
    else
        at.take_strokes(3);  // an automatic station does not know the type
    if (!at.at_end()) return MetarForm::kOther;
    out.clouds.push_back(cloud);
    return MetarForm::kRead;
}

MetarForm read_metar_temperature(std::string_view word, Metar& out) {
    MetarCursor at(word);
    bool given = false, dew_given = false;
    double celsius = 0, dew = 0;
    if (!take_temperature(at, given, celsius) || !at.take("/")) return MetarForm::kOther;
    if (!at.at_end() && (!take_temperature(at, dew_given, dew) || !at.at_end()))
        return MetarForm::kOther;
    out.temperature_given = given, out.temperature_c = celsius;
    out.dew_point_given = dew_given, out.dew_point_c = dew;
    return MetarForm::kRead;
}

MetarForm read_metar_pressure(std::string_view word, Metar& out) {
    MetarCursor at(word);
    const bool inches = at.take("A");
    int number = 0;
    if (!inches && !at.take("QNH") && !at.take("Q")) return MetarForm::kOther;
    if (at.take_strokes(4) && at.at_end()) return MetarForm::kRead;
    if (!at.take_digits(4, 4, number)) return MetarForm::kOther;
    const bool more_inches = inches || at.take("INS");
    if (!at.at_end()) return MetarForm::kOther;
    const double hpa = more_inches ? number * 0.01 * kInch_hpa : number;
    // Beyond all pressures on record, 870 to 1085: a slip that no picture shows, so it is listed.
    if (hpa < 800 || hpa > 1150) return MetarForm::kOther;
    out.pressure_hpa = hpa;
    return MetarForm::kRead;
}

}  // namespace pileus
