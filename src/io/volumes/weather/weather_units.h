// SPDX-License-Identifier: Apache-2.0
// Units that weather data may have.
// in: the text of an attribute `units` -> out: factor and offset to the unit that is used here.
// docs/weather.md, "Units"; UDUNITS-2 for the spellings.
#pragma once
#include <string>

#include "src/base/status.h"

namespace pileus {

enum class Quantity {
    kRatio,         ///< kg/kg
    kContent,       ///< kg/m3
    kFraction,      ///< 1
    kTemperature,   ///< K
    kPressure,      ///< Pa
    kHeight,        ///< m
    kGeopotential,  ///< m2/s2
    kRadius,        ///< m
    kDegrees,       ///< degrees, of longitude or latitude
};

/// What DALES calls its ratios, whose values are kg/kg all the same.
constexpr const char* kDalesUnit = "1e-5kg/kg";

struct UnitScale {
    double factor = 1, offset = 0;  ///< value = factor * number + offset
};

/// False where the text is none of the units of that quantity.
bool find_unit(const std::string& text, Quantity quantity, UnitScale& scale);

/// "Pa, hPa, mbar": units of a quantity, for messages and documents.
std::string unit_names(Quantity quantity);

}  // namespace pileus
