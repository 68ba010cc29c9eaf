// SPDX-License-Identifier: Apache-2.0
// What a scene says of a file of weather data: which variables, when, and how they become a cloud.
// in: keys of medium.density -> out: plain values.
// docs/weather.md.
#pragma once
#include <array>
#include <string>

namespace pileus {

/// Texts that are empty are left out: then the variable is looked for; "none": it is not used.
struct WeatherSettings {
    std::string liquid, ice, cloud_fraction, temperature, pressure, humidity, height;
    std::string liquid_radius, ice_radius, surface_pressure, surface_geopotential;
    std::string variable;  ///< any field, shown by medium.transfer; empty: the water above
    std::string time = "0", member = "0";  ///< a whole number counts from 0; else a name
    bool in_cloud = false;        ///< fraction = "in_cloud": water is divided by the cloud fraction
    double liquid_radius_um = 0;  ///< effective; 0: of the file, or else 10
    double ice_radius_um = 0;     ///< effective; 0: of the file, or else 30
    double ice_dge_um = 0;        ///< Fu's generalized effective size; 0: the radius counts
    bool missing_is_fault = false;
    bool plain_degrees = false;                  ///< geometry = "plain"
    std::array<double, 2> origin_deg{1e9, 1e9};  ///< longitude, latitude; 1e9: the middle
    double width_m = 0;                          ///< of a slice or a column, across; 0: a default
    double vertical_scale = 1;
};

}  // namespace pileus
