// SPDX-License-Identifier: Apache-2.0
// Which variables of a file are cloud water, temperature, pressure and so on.
// in: a head and the names that a scene gives -> out: fields: variables that are added, their unit.
// docs/weather.md, "Variables"; CF standard names; names of ecRad, ECMWF, ICON, COSMO and WRF.
#pragma once
#include "src/base/span.h"
#include "src/io/volumes/weather/weather_axes.h"
#include "src/io/volumes/weather/weather_units.h"

namespace pileus {

enum class Role : std::size_t {
    kLiquid,
    kIce,
    kFraction,
    kTemperature,
    kPressure,
    kHeight,
    kHumidity,
    kLiquidRadius,
    kIceRadius,
    kSurfacePressure,
    kSurfaceHeight,
    kShown,  ///< any variable that a transfer function shows in place of water
    kCount
};

/// What has to be done with the numbers once they are in the unit of their quantity.
enum class Meaning {
    kPlain,
    kPotential,     ///< potential temperature, K
    kGeopotential,  ///< m2/s2, over `gravity` is the height
    kLogarithm,     ///< of a pressure in Pa
    kPerDryAir,     ///< mixing ratio: per kg of dry air
};

struct WeatherField {
    std::vector<const NcVariable*> parts;  ///< are added up; empty: the file has none
    Quantity quantity = Quantity::kRatio;
    Meaning meaning = Meaning::kPlain;
    UnitScale unit;
    double gravity = 9.80665;
    bool on_faces = false;      ///< between levels: one more value than levels
    bool above_ground = false;  ///< heights that count from the ground
    bool there() const { return !parts.empty(); }
    std::string name() const;  ///< "P + PB"
};

struct WeatherFields {
    WeatherField of[std::size_t(Role::kCount)];
    WeatherField& operator[](Role role) { return of[std::size_t(role)]; }
    const WeatherField& operator[](Role role) const { return of[std::size_t(role)]; }
};

/// Heights that count from the ground: standard_name "height", or words that say so.
bool is_above_ground(const NcVariable& variable);
/// Levels that are numbered, not placed: a generalized height, a model level, 1 to n without a
/// unit.
bool is_level_number(const NcFile& file, const NcVariable& variable);

/// Key of the scene that names the variable: "liquid".
const char* role_key(Role role);

/// The variable that is shown, of liquid water or else of ice, by which the axes are known.
/// kBadInput: none of them.
Status find_water(const NcFile& file, const WeatherSettings& settings, const NcVariable*& water);

/// All roles. kBadInput: a variable that the scene names is not there or has other dimensions, a
/// unit is missing or of another quantity.
Status find_fields(const NcFile& file, const WeatherSettings& settings, const WeatherAxes& axes,
                   WeatherFields& fields);

// Names under which files hold cloud water, temperature, pressure and so on: rows of which the
// first that fits wins.

/// One way to say a role. A name of two parts is a sum: "P+PB".
struct WeatherName {
    Role role;
    const char* name;  ///< of a variable; of WRF ones, where the file is one of its
    const char* standard_name;
    Quantity quantity;
    Meaning meaning = Meaning::kPlain;
    double offset = 0;  ///< added
    bool wrf = false;
};

Span<const WeatherName> weather_names();

}  // namespace pileus
