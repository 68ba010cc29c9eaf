// SPDX-License-Identifier: Apache-2.0
// The table of units.
// in: texts -> out: see weather_units.h.
// docs/weather.md, "Units"; UDUNITS-2 for the spellings.
#include "src/io/volumes/weather/weather_units.h"

#include "src/base/number_text.h"

namespace pileus {
namespace {

struct UnitRow {
    Quantity quantity;
    const char* name;
    double factor, offset;
};

// Rows are looked through before a leading number is taken for a factor: DALES writes kg/kg under
// this name, which is that of its packed files (dalesteam/dales, modfielddump.f90).
constexpr UnitRow kRows[] = {
    {Quantity::kRatio, "kg kg-1", 1, 0},
    {Quantity::kRatio, "kg/kg", 1, 0},
    {Quantity::kRatio, "1", 1, 0},
    {Quantity::kRatio, "g kg-1", 1e-3, 0},
    {Quantity::kRatio, "g/kg", 1e-3, 0},
    {Quantity::kRatio, "mg kg-1", 1e-6, 0},
    {Quantity::kRatio, "mg/kg", 1e-6, 0},
    {Quantity::kRatio, "g g-1", 1, 0},
    {Quantity::kRatio, "g/g", 1, 0},
    {Quantity::kRatio, kDalesUnit, 1, 0},
    {Quantity::kContent, "kg m-3", 1, 0},
    {Quantity::kContent, "kg/m3", 1, 0},
    {Quantity::kContent, "g m-3", 1e-3, 0},
    {Quantity::kContent, "g/m3", 1e-3, 0},
    {Quantity::kContent, "mg m-3", 1e-6, 0},
    {Quantity::kContent, "mg/m3", 1e-6, 0},
    {Quantity::kFraction, "1", 1, 0},
    {Quantity::kFraction, "(0 - 1)", 1, 0},
    {Quantity::kFraction, "", 1, 0},
    {Quantity::kFraction, "%", 0.01, 0},
    {Quantity::kFraction, "percent", 0.01, 0},
    {Quantity::kTemperature, "K", 1, 0},
    {Quantity::kTemperature, "kelvin", 1, 0},
    {Quantity::kTemperature, "degC", 1, 273.15},
    {Quantity::kTemperature, "celsius", 1, 273.15},
    {Quantity::kTemperature, "degree_Celsius", 1, 273.15},
    {Quantity::kTemperature, "degrees_Celsius", 1, 273.15},
    {Quantity::kTemperature, "Celsius", 1, 273.15},
    {Quantity::kTemperature, "degree_C", 1, 273.15},
    {Quantity::kTemperature, "degrees_C", 1, 273.15},
    {Quantity::kTemperature,
     "\xc2\xb0"
     "C",
     1, 273.15},
    {Quantity::kTemperature, "Kelvin", 1, 0},
    {Quantity::kTemperature, "degK", 1, 0},
    {Quantity::kPressure, "Pa", 1, 0},
    {Quantity::kPressure, "pascal", 1, 0},
    {Quantity::kPressure, "hPa", 100, 0},
    {Quantity::kPressure, "kPa", 1000, 0},
    {Quantity::kPressure, "mb", 100, 0},
    {Quantity::kPressure, "mbar", 100, 0},
    {Quantity::kPressure, "millibar", 100, 0},
    {Quantity::kPressure, "millibars", 100, 0},
    {Quantity::kPressure, "hectopascal", 100, 0},
    {Quantity::kPressure, "hectopascals", 100, 0},
    {Quantity::kPressure, "pascals", 1, 0},
    {Quantity::kPressure, "bar", 1e5, 0},
    {Quantity::kPressure, "dbar", 1e4, 0},
    {Quantity::kPressure, "decibar", 1e4, 0},
    {Quantity::kPressure, "atm", 101325, 0},
    {Quantity::kHeight, "m", 1, 0},
    {Quantity::kHeight, "metre", 1, 0},
    {Quantity::kHeight, "meter", 1, 0},
    {Quantity::kHeight, "meters", 1, 0},
    {Quantity::kHeight, "metres", 1, 0},
    {Quantity::kHeight, "gpm", 1, 0},
    {Quantity::kHeight, "km", 1000, 0},
    {Quantity::kHeight, "kilometer", 1000, 0},
    {Quantity::kHeight, "kilometers", 1000, 0},
    {Quantity::kHeight, "kilometre", 1000, 0},
    {Quantity::kHeight, "kilometres", 1000, 0},
    {Quantity::kHeight, "dam", 10, 0},
    {Quantity::kHeight, "ft", 0.3048, 0},
    {Quantity::kHeight, "feet", 0.3048, 0},
    {Quantity::kGeopotential, "m2 s-2", 1, 0},
    {Quantity::kGeopotential, "m2/s2", 1, 0},
    {Quantity::kGeopotential, "J kg-1", 1, 0},
    {Quantity::kRadius, "m", 1, 0},
    {Quantity::kRadius, "um", 1e-6, 0},
    {Quantity::kRadius, "micron", 1e-6, 0},
    {Quantity::kRadius, "microns", 1e-6, 0},
    {Quantity::kRadius, "micrometer", 1e-6, 0},
    {Quantity::kRadius, "micrometre", 1e-6, 0},
    {Quantity::kDegrees, "degrees", 1, 0},
    {Quantity::kDegrees, "degree", 1, 0},
    {Quantity::kDegrees, "deg", 1, 0},
    {Quantity::kDegrees, "degrees_N", 1, 0},
    {Quantity::kDegrees, "degree_N", 1, 0},
    {Quantity::kDegrees, "degreesN", 1, 0},
    {Quantity::kDegrees, "degreeN", 1, 0},
    {Quantity::kDegrees, "degrees_E", 1, 0},
    {Quantity::kDegrees, "degree_E", 1, 0},
    {Quantity::kDegrees, "degreesE", 1, 0},
    {Quantity::kDegrees, "degreeE", 1, 0},
    {Quantity::kDegrees, "degrees_north", 1, 0},
    {Quantity::kDegrees, "degree_north", 1, 0},
    {Quantity::kDegrees, "degrees_east", 1, 0},
    {Quantity::kDegrees, "degree_east", 1, 0},
    {Quantity::kDegrees, "radian", 57.295779513082320877, 0},
    {Quantity::kDegrees, "radians", 57.295779513082320877, 0},
};

/// "kg m**-3", "kg.m^-3" and "kg  m-3" are the same; so are "kg m^{-3}" and "\xc2\xb5m" and "um".
/// A point between digits stays.
std::string plain(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '*' || c == '^' || c == '{' || c == '}') continue;
        const bool decimal = c == '.' && (i > 0 && text[i - 1] >= '0' && text[i - 1] <= '9') &&
                             i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9';
        if (c == ' ' || (c == '.' && !decimal) || c == '\t') {
            if (!out.empty() && out.back() != ' ') out += ' ';
            continue;
        }
        // Micro, by either of its letters.
        const bool micro = i + 1 < text.size() && ((c == '\xc2' && text[i + 1] == '\xb5') ||
                                                   (c == '\xce' && text[i + 1] == '\xbc'));
        if (micro) {
            out += 'u';
            ++i;
            continue;
        }
        out += c;
    }
    while (!out.empty() && out.back() == ' ') out.pop_back();
    return out;
}

bool find_row(const std::string& name, Quantity quantity, UnitScale& scale) {
    for (const UnitRow& row : kRows) {
        if (row.quantity != quantity || name != row.name) continue;
        scale = {row.factor, row.offset};
        return true;
    }
    return false;
}

/// Takes "1e-3", "0.001", "10-3" (10^-3) and blanks off the front of a unit.
bool take_factor(std::string& unit, double& factor) {
    const char *from = unit.data(), *end = from + unit.size();
    auto read = number_from(from, end, factor);
    if (read.ec != std::errc() || !(factor > 1e-30 && factor < 1e30)) return false;
    int power = 0;
    if (factor == 10 && read.ptr < end && *read.ptr == '-') {
        const auto after = number_from(read.ptr, end, power);
        if (after.ec != std::errc() || power < -30) return false;
        read.ptr = after.ptr;
        for (factor = 1; power < 0; ++power) factor /= 10;
    }
    while (read.ptr < end && *read.ptr == ' ') ++read.ptr;
    unit.assign(read.ptr, end);
    return !unit.empty();
}

}  // namespace

bool find_unit(const std::string& text, Quantity quantity, UnitScale& scale) {
    std::string wanted = plain(text);
    if (find_row(wanted, quantity, scale)) return true;
    if (wanted.size() > 2 && wanted.front() == '(' && wanted.back() == ')') {
        wanted = wanted.substr(1, wanted.size() - 2);
        if (find_row(wanted, quantity, scale)) return true;
    }
    double factor = 1;
    if (!take_factor(wanted, factor) || !find_row(wanted, quantity, scale)) return false;
    scale.factor *= factor;
    return scale.offset == 0;
}

std::string unit_names(Quantity quantity) {
    std::string list;
    for (const UnitRow& row : kRows)
        if (row.quantity == quantity && row.name[0] != '\0' && std::string(row.name) != kDalesUnit)
            list += (list.empty() ? "" : ", ") + std::string(row.name);
    return list;
}

}  // namespace pileus
