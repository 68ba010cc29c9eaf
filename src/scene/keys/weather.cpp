// SPDX-License-Identifier: Apache-2.0
// Keys of weather data: names of variables, time, microphysics, geometry.
// in: checked values <-> out: fields of WeatherSettings.
// docs/weather.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField weather = field<&MediumSettings::weather, Members...>;
template <auto Member>
constexpr KeyField names = weather<&WeatherSettings::names, Member>;
template <auto Member>
constexpr KeyField sizes = weather<&WeatherSettings::sizes, Member>;
template <auto Member>
constexpr KeyField place = weather<&WeatherSettings::place, Member>;

/// A whole number or a text.
template <auto Member>
constexpr KeyField choice{KeyKind::kIndexOrText,
                          [](const KeySource& s) {
                              const WeatherChoice& value = s.medium.weather.*Member;
                              return value.by_name ? node_of(value.name) : node_of(value.index);
                          },
                          [](const KeyTarget& t, const Node& n) {
                              WeatherChoice& value = t.medium.weather.*Member;
                              value = WeatherChoice();
                              value.by_name = n.is_text();
                              if (n.is_text())
                                  take(n, value.name);
                              else
                                  value.index = integer_of(n);
                          }};

using W = WeatherSettings;

constexpr KeyRow kRows[] = {
    {"medium.N.density.liquid", names<&WeatherNames::liquid>, any(), "",
     "NetCDF: variable of cloud liquid water, or `none`; left out, as for the ten below: found by "
     "its standard_name or a known name",
     kNoNote},
    {"medium.N.density.ice", names<&WeatherNames::ice>, any(), "",
     "variable of cloud ice, or `none`", kNoNote},
    {"medium.N.density.cloud_fraction", names<&WeatherNames::cloud_fraction>, any(), "",
     "variable of the cloud fraction, or `none`", kNoNote},
    {"medium.N.density.temperature", names<&WeatherNames::temperature>, any(), "",
     "variable of temperature or potential temperature", kNoNote},
    {"medium.N.density.pressure", names<&WeatherNames::pressure>, any(), "", "variable of pressure",
     kNoNote},
    {"medium.N.density.humidity", names<&WeatherNames::humidity>, any(), "",
     "variable of specific humidity or of the vapour's mixing ratio, or `none`: dry air", kNoNote},
    {"medium.N.density.height", names<&WeatherNames::height>, any(), "",
     "variable of height or geopotential, or `none`: integrated from pressures", kNoNote},
    {"medium.N.density.liquid_radius", names<&WeatherNames::liquid_radius>, any(), "",
     "variable of the droplets' effective radius, or `none`", kNoNote},
    {"medium.N.density.ice_radius", names<&WeatherNames::ice_radius>, any(), "",
     "variable of the crystals' effective radius, or `none`", kNoNote},
    {"medium.N.density.surface_pressure", names<&WeatherNames::surface_pressure>, any(), "",
     "variable of the pressure at the ground, or `none`", kNoNote},
    {"medium.N.density.surface_geopotential", names<&WeatherNames::surface_geopotential>, any(), "",
     "variable of the ground's geopotential or height, or `none`: 0", kNoNote},
    {"medium.N.density.variable", names<&WeatherNames::variable>, any(), "",
     "variable that `transfer` shows in place of water, in its own unit", kNoNote},
    {"medium.N.density.axes", names<&WeatherNames::axes>, any(), "",
     "what dimensions are that the file does not tell: `time`, `member`, `level`, `y`, `x` or "
     "`column`, as `x: ni, y: nj, level: nk`",
     kNoNote},
    {"medium.N.density.units", names<&WeatherNames::units>, any(), "",
     "units of variables whose own is missing or wrong, as `ql: kg kg-1, x: km`", kNoNote},
    {"medium.N.density.time", choice<&W::time>, from_to(0, 1e9), "",
     "which time of a NetCDF file: an index from 0, or as text a date such as "
     "`2005-08-28T12` with which one time's date begins"},
    {"medium.N.density.member", choice<&W::member>, from_to(0, 1e9), "",
     "which member of an ensemble: an index from 0, or as text the number or name that the file "
     "gives it"},
    {"medium.N.density.fraction", weather<&W::in_cloud>, one_of("mean|in_cloud"), "",
     "`mean`: a cell's water fills it, `in_cloud`: is divided by the cloud fraction first"},
    {"medium.N.density.liquid_radius_um", sizes<&WeatherSizes::liquid_radius_um>, positive(1e4),
     "um", "effective radius of all droplets; left out: the file's, else 10", kNoNote},
    {"medium.N.density.ice_radius_um", sizes<&WeatherSizes::ice_radius_um>, positive(1e4), "um",
     "effective radius of all crystals; left out: the file's, else 30", kNoNote},
    {"medium.N.density.ice_dge_um", sizes<&WeatherSizes::ice_dge_um>, positive(1e4), "um",
     "generalized effective size of all crystals (Fu 1996), in place of a radius", kNoNote},
    {"medium.N.density.missing", weather<&W::missing_is_fault>, one_of("clear|fault"), "",
     "what missing values of water are: no cloud, counted, or a fault"},
    {"medium.N.density.geometry", place<&WeatherPlace::plain_degrees>, one_of("cosine|plain"), "",
     "degrees of longitude as metres: times the cosine of latitude, or not"},
    {"medium.N.density.origin_deg", place<&WeatherPlace::origin_deg>, from_to(-360, 360), "deg",
     "longitude and latitude of x = y = 0; left out: the middle of the data", kNoNote},
    {"medium.N.density.width_m", place<&WeatherPlace::width_m>, positive(1e9), "m",
     "width of a slice or a single column, across; left out: the spacing of a slice's columns, "
     "10 km for a single one",
     kNoNote},
    {"medium.N.density.vertical_scale", place<&WeatherPlace::vertical_scale>, positive(1e4), "",
     "factor on heights; extinction is divided by it, so that optical depths stay"},
};

}  // namespace

Span<const KeyRow> weather_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
