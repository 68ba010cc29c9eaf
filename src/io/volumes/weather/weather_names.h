// SPDX-License-Identifier: Apache-2.0
// Names under which files hold cloud water, temperature, pressure and so on.
// in: the table in weather_names.cpp -> out: rows, the first that fits wins.
// docs/weather.md, "Variables"
#pragma once
#include "src/base/span.h"
#include "src/io/volumes/weather/weather_fields.h"

namespace pileus {

/// One way to say a role. A name of two parts is a sum: "P+PB".
struct WeatherName {
    Role role;
    const char* name;  ///< of a variable; of WRF ones, where there is PB
    const char* standard_name;
    Quantity quantity;
    Meaning meaning = Meaning::kPlain;
    double offset = 0;  ///< added
    bool wrf = false;
};

Span<const WeatherName> weather_names();

}  // namespace pileus
