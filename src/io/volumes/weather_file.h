// SPDX-License-Identifier: Apache-2.0
// A file of weather data that is opened once: for the map, the sizes and the values.
// in: a path -> out: the opened file; a GRIB file is decoded once.
// docs/weather.md
#pragma once
#include <memory>

#include "src/io/netcdf/netcdf_file.h"
#include "src/io/volumes/weather_map.h"
#include "src/scene/scene.h"

namespace pileus {

/// Shared by the copies of a scene in one session, and by its media of one file; for one thread.
class WeatherFile {
public:
    /// Its length on the disk, before anything of it is read. Errors: NcFile's.
    Status size(const std::string& path, std::uint64_t& bytes);
    /// Opens it at the first call, and where the path is another one than before. Errors: NcFile's.
    Status open(const std::string& path, const NcFile*& file);
    /// The map of the file under these settings; read once.
    Status map(const WeatherSettings& settings, const std::string& path, WeatherMap& map);
    /// All values have been read: keeps the map alone. Whoever asks again opens it anew.
    void close(const WeatherSettings& settings);

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
/// After the values of all media have been read.
void close_weather_files(const Scene& scene);

}  // namespace pileus
