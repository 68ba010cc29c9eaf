// SPDX-License-Identifier: Apache-2.0
// The map of a file of weather data: where a longitude and a latitude lie in the medium's metres.
// in: an opened file -> out: x, y of places; the map as PROJ writes it.
// docs/weather.md, "Places"; Snyder, "Map Projections - A Working Manual" (1987), on the sphere.
#pragma once
#include "src/io/volumes/weather/weather_source.h"
#include "src/scene/scene.h"

namespace pileus {

enum class MapKind { kDegrees, kPlain, kRotated, kConic, kMercator, kPolar };

struct WeatherMap {
    MapKind kind = MapKind::kDegrees;
    double origin[2] = {0, 0};  ///< as Footprints::origin
    double squeeze = 1;
    bool by_rows = true;  ///< of degrees: with the cosine of each row
    std::vector<double> y_edges, row_scale;
    double pole_lon = 180, pole_lat = 90, pole_turn = 0;  ///< of a rotated pole, degrees
    double radius = 6370000;                              ///< of the projection's sphere, m
    double parallel[2] = {0, 0};                          ///< of true scale, degrees
    double meridian = 0;                                  ///< in the middle, degrees
    double shift[2] = {0, 0};  ///< x, y of the medium less those of the projection, m
    double vertical_scale = 1;

    /// x, y in metres and z = height times the scene's scale; kBadInput: beyond what the map shows.
    Status place(const std::string& where, const Double3& lon_lat_height, Double3& metres) const;

    /// "+proj=merc ..."; x and y of it are those of the medium.
    std::string projection() const;
};

/// kBadInput: a file that says of no map: a grid in metres, a column without a place.
Status find_map(const NcFile& file, const WeatherSettings& settings, WeatherMap& map);

/// The map of a file of weather data that a medium names.
Status read_weather_map(const MediumSettings& medium, const std::string& path, WeatherMap& map);

}  // namespace pileus
