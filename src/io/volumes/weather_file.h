// SPDX-License-Identifier: Apache-2.0
// Files of weather data that are opened once: for the map, the sizes and the values.
// in: a path -> out: the opened file; a GRIB file is decoded once.
// docs/weather.md
#pragma once
#include <map>
#include <memory>

#include "src/io/netcdf/netcdf_file.h"
#include "src/io/volumes/weather/weather_source.h"
#include "src/scene/scene.h"

namespace pileus {

// The map of a file of weather data: where a longitude and a latitude lie in the medium's metres.
// docs/weather.md, "Places"; Snyder, "Map Projections - A Working Manual" (1987), on the sphere.

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

/// Files of weather data by their paths, which what reads a scene shares; for one thread. Errors:
/// NcFile's.
class WeatherFiles {
public:
    /// Length of one on the disk, before anything of it is read.
    Status size(const std::string& path, std::uint64_t& bytes);
    /// Opens it at the first call.
    Status open(const std::string& path, const NcFile*& file);
    /// Its map under the settings of the first medium that shows it; read once.
    Status map(const WeatherSettings& settings, const std::string& path, WeatherMap& map);
    /// Its values have been read; the map stays. Who asks again opens it again.
    void close(const std::string& path);

private:
    struct Kept {
        std::unique_ptr<NcFile> file;
        bool opened = false;  ///< its head has been read
        std::unique_ptr<WeatherMap> map;
        Status map_status;
    };
    Status find(const std::string& path, Kept*& kept);

    std::map<std::string, Kept> files_;
};
/// None is open yet. Null in a flight.
std::shared_ptr<WeatherFiles> make_weather_files();

/// The map of a medium's file of weather data. `files` null: it is opened for that alone.
Status read_weather_map(const MediumSettings& medium, const std::string& path, WeatherMap& map,
                        WeatherFiles* files = nullptr);
/// Length of a medium's file of any kind, likewise. Errors: those of opening it.
Status density_file_bytes(const MediumSettings& medium, const std::string& path,
                          std::uint64_t& bytes, WeatherFiles* files);
/// After the values of all media have been read; the map stays for cameras whose pictures tell
/// their place.
void close_weather_files(const Scene& scene, WeatherFiles& files);

}  // namespace pileus
