// SPDX-License-Identifier: Apache-2.0
// A file of weather data that is opened once: for the map, the sizes and the values.
// in: a path -> out: the opened file; a GRIB file is decoded once.
// docs/weather.md
#pragma once
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

/// The map of a file of weather data that a medium names.
Status read_weather_map(const MediumSettings& medium, const std::string& path, WeatherMap& map);

/// Shared by the copies of a scene in one session, and by its media of one file; for one thread.
class WeatherFile {
public:
    /// Its length on the disk, before anything of it is read. Errors: NcFile's.
    Status size(const std::string& path, std::uint64_t& bytes);
    /// Opens it at the first call, and where the path is another one than before. Errors: NcFile's.
    Status open(const std::string& path, const NcFile*& file);
    /// The map of the file under the settings of the first medium that shows it; read once.
    Status map(const WeatherSettings& settings, const std::string& path, WeatherMap& map);
    /// All values have been read. Whoever asks again opens it again.
    void close();

private:
    Status find(const std::string& path);

    std::string path_;
    std::unique_ptr<NcFile> file_;
    bool opened_ = false;  ///< its head has been read
    std::unique_ptr<WeatherMap> map_;
    Status map_status_;
};

/// The opened file of a medium: the scene's, or else `own`.
Status open_weather_file(const MediumSettings& medium, const std::string& path, NcFile& own,
                         const NcFile*& file);

/// Length of a medium's file of any kind. Errors: those of opening it.
Status density_file_bytes(const MediumSettings& medium, const std::string& path,
                          std::uint64_t& bytes);

/// Gives each medium of weather data its file, which media of the same file share; none is opened.
void share_weather_files(Scene& scene);
/// After the values of all media have been read; the map stays for cameras whose pictures tell
/// their place.
void close_weather_files(const Scene& scene);

}  // namespace pileus
