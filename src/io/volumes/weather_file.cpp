// SPDX-License-Identifier: Apache-2.0
// See weather_file.h.
#include "src/io/volumes/weather_file.h"

#include "src/base/file.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/volume_format.h"

namespace pileus {

Status WeatherFile::find(const std::string& path) {
    if (path != path_) map_.reset();
    if (file_ != nullptr && path == path_) return Status::ok();
    path_ = path;
    opened_ = false;
    file_ = std::make_unique<NcFile>();
    const Status found = file_->find(path);
    if (!found) file_.reset();
    return found;
}

Status WeatherFile::size(const std::string& path, std::uint64_t& bytes) {
    PILEUS_TRY(find(path));
    bytes = file_->file_bytes();
    return Status::ok();
}

Status WeatherFile::open(const std::string& path, const NcFile*& file) {
    PILEUS_TRY(find(path));
    if (!opened_) {
        const Status opened = file_->open(path);
        if (!opened) {
            file_.reset();
            return opened;
        }
        opened_ = true;
    }
    file = file_.get();
    return Status::ok();
}

Status WeatherFile::map(const WeatherSettings& settings, const std::string& path, WeatherMap& map) {
    if (map_ == nullptr || path != path_) {
        const NcFile* file = nullptr;
        PILEUS_TRY(open(path, file));
        map_ = std::make_unique<WeatherMap>();
        map_status_ = find_map(*file, settings, *map_);
    }
    map = *map_;
    return map_status_;
}

void WeatherFile::close() { file_.reset(); }

Status open_weather_file(const MediumSettings& medium, const std::string& path, NcFile& own,
                         const NcFile*& file) {
    if (medium.weather_file != nullptr) return medium.weather_file->open(path, file);
    PILEUS_TRY(own.open(path));
    file = &own;
    return Status::ok();
}

Status density_file_bytes(const MediumSettings& medium, const std::string& path,
                          std::uint64_t& bytes) {
    if (medium.weather_file != nullptr) return medium.weather_file->size(path, bytes);
    InputFile file;
    PILEUS_TRY(open_file(path, file));
    bytes = file.size();
    return Status::ok();
}

void share_weather_files(Scene& scene) {
    for (MediumSettings& medium : scene.media) {
        medium.weather_file.reset();
        const VolumeFormat* format = volume_format_named(medium.format);
        if (format == nullptr || !format->is_weather) continue;
        for (const MediumSettings& other : scene.media)
            if (other.file == medium.file && other.weather_file != nullptr)
                medium.weather_file = other.weather_file;
        if (medium.weather_file == nullptr) medium.weather_file = std::make_shared<WeatherFile>();
    }
}

void close_weather_files(const Scene& scene) {
    bool mapped = !scene.camera.orthographic;
    for (const MediumSettings& medium : scene.media) {
        if (medium.weather_file == nullptr) continue;
        // That of the first one is asked for when the picture is made; whether there is one, too.
        WeatherMap map;
        if (!mapped) (void)read_weather_map(medium, density_path(scene, medium), map);
        mapped = true;
        medium.weather_file->close();
    }
}

}  // namespace pileus
