// SPDX-License-Identifier: Apache-2.0
// The table of units.
// in: texts -> out: see weather_units.h.
// docs/weather.md, "Units"; UDUNITS-2 for the spellings.
#include "src/io/volumes/weather/weather_units.h"

namespace pileus {
namespace {

struct UnitRow {
    Quantity quantity;
    const char* name;
    double factor, offset;
};

constexpr UnitRow kRows[] = {
    {Quantity::kRatio, "kg kg-1", 1, 0},
    {Quantity::kRatio, "kg/kg", 1, 0},
    {Quantity::kRatio, "1", 1, 0},
    {Quantity::kRatio, "g kg-1", 1e-3, 0},
    {Quantity::kRatio, "g/kg", 1e-3, 0},
    {Quantity::kRatio, "mg kg-1", 1e-6, 0},
    {Quantity::kRatio, "mg/kg", 1e-6, 0},
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
    {Quantity::kPressure, "Pa", 1, 0},
    {Quantity::kPressure, "pascal", 1, 0},
    {Quantity::kPressure, "hPa", 100, 0},
    {Quantity::kPressure, "kPa", 1000, 0},
    {Quantity::kPressure, "mb", 100, 0},
    {Quantity::kPressure, "mbar", 100, 0},
    {Quantity::kPressure, "millibar", 100, 0},
    {Quantity::kPressure, "millibars", 100, 0},
    {Quantity::kHeight, "m", 1, 0},
    {Quantity::kHeight, "metre", 1, 0},
    {Quantity::kHeight, "meter", 1, 0},
    {Quantity::kHeight, "meters", 1, 0},
    {Quantity::kHeight, "gpm", 1, 0},
    {Quantity::kHeight, "km", 1000, 0},
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
    {Quantity::kDegrees, "degrees_north", 1, 0},
    {Quantity::kDegrees, "degree_north", 1, 0},
    {Quantity::kDegrees, "degrees_N", 1, 0},
    {Quantity::kDegrees, "degrees_east", 1, 0},
    {Quantity::kDegrees, "degree_east", 1, 0},
    {Quantity::kDegrees, "degrees_E", 1, 0},
    {Quantity::kDegrees, "radian", 57.295779513082320877, 0},
    {Quantity::kDegrees, "radians", 57.295779513082320877, 0},
};

/// "kg m**-3", "kg.m^-3" and "kg  m-3" are the same; so are "kg m^{-3}" and "\xc2\xb5m" and "um".
std::string plain(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '*' || c == '^' || c == '{' || c == '}') continue;
        if (c == ' ' || c == '.' || c == '\t') {
            if (!out.empty() && out.back() != ' ') out += ' ';
            continue;
        }
        if (c == '\xc2' && i + 1 < text.size() && text[i + 1] == '\xb5') {
            out += 'u';
            ++i;
            continue;
        }
        out += c;
    }
    while (!out.empty() && out.back() == ' ') out.pop_back();
    return out;
}

}  // namespace

bool find_unit(const std::string& text, Quantity quantity, UnitScale& scale) {
    const std::string wanted = plain(text);
    for (const UnitRow& row : kRows) {
        if (row.quantity != quantity || wanted != row.name) continue;
        scale = {row.factor, row.offset};
        return true;
    }
    return false;
}

std::string unit_names(Quantity quantity) {
    std::string list;
    for (const UnitRow& row : kRows)
        if (row.quantity == quantity && row.name[0] != '\0')
            list += (list.empty() ? "" : ", ") + std::string(row.name);
    return list;
}

}  // namespace pileus
