// SPDX-License-Identifier: Apache-2.0
// See weather_file.h.
#include "src/io/volumes/weather_file.h"

#include "src/base/file.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/volume_format.h"

namespace pileus {

Status WeatherFiles::find(const std::string& path, Kept*& kept) {
    kept = &files_[path];
    if (kept->file != nullptr) return Status::ok();
    kept->opened = false;
    kept->file = std::make_unique<NcFile>();
    const Status found = kept->file->find(path);
    if (!found) kept->file.reset();
    return found;
}

Status WeatherFiles::size(const std::string& path, std::uint64_t& bytes) {
    Kept* kept = nullptr;
    PILEUS_TRY(find(path, kept));
    bytes = kept->file->file_bytes();
    return Status::ok();
}

Status WeatherFiles::open(const std::string& path, const NcFile*& file) {
    Kept* kept = nullptr;
    PILEUS_TRY(find(path, kept));
    if (!kept->opened) {
        const Status opened = kept->file->open(path);
        if (!opened) {
            kept->file.reset();
            return opened;
        }
        kept->opened = true;
    }
    file = kept->file.get();
    return Status::ok();
}

Status WeatherFiles::map(const WeatherSettings& settings, const std::string& path,
                         WeatherMap& map) {
    Kept& kept = files_[path];
    if (kept.map == nullptr) {
        const NcFile* file = nullptr;
        PILEUS_TRY(open(path, file));
        kept.map = std::make_unique<WeatherMap>();
        kept.map_status = find_map(*file, settings, *kept.map);
    }
    map = *kept.map;
    return kept.map_status;
}

void WeatherFiles::close(const std::string& path) { files_[path].file.reset(); }

std::shared_ptr<WeatherFiles> make_weather_files() { return std::make_shared<WeatherFiles>(); }

Status read_weather_map(const MediumSettings& medium, const std::string& path, WeatherMap& map,
                        WeatherFiles* files) {
    if (files != nullptr) return files->map(medium.weather, path, map);
    NcFile file;
    PILEUS_TRY(file.open(path));
    return find_map(file, medium.weather, map);
}

Status density_file_bytes(const MediumSettings& medium, const std::string& path,
                          std::uint64_t& bytes, WeatherFiles* files) {
    if (files != nullptr && is_weather_format(medium.source.format))
        return files->size(path, bytes);
    InputFile file;
    PILEUS_TRY(open_file(path, file));
    bytes = file.size();
    return Status::ok();
}

void close_weather_files(const Scene& scene, WeatherFiles& files) {
    bool mapped = !scene.camera.orthographic;
    for (const MediumSettings& medium : scene.media) {
        if (!is_weather_format(medium.source.format)) continue;
        const std::string path = density_path(scene, medium);
        // That of the first one is asked for when the picture is made; whether there is one, too.
        WeatherMap map;
        if (!mapped) (void)files.map(medium.weather, path, map);
        mapped = true;
        files.close(path);
    }
}

}  // namespace pileus
