// SPDX-License-Identifier: Apache-2.0
// Chooses a reader for a density grid, and turns grids into the project's axes.
// in: a medium's settings and a path -> out: a Volume in file order; the turn to z up apart.
// docs/formats.md
#include "src/io/volumes/volume_file.h"

#include "src/base/file.h"
#include "src/io/volumes/weather_file.h"
#include "src/scene/rows/volume_format.h"

namespace pileus {

Status check_volume_size(const std::string& where, const std::array<std::int64_t, 3>& size) {
    static const char* const names[3] = {"nx", "ny", "nz"};
    std::uint64_t cells = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (size[axis] < 1 || size[axis] > kMaxVolumeSide)
            return Status::bad_input(where + ": " + names[axis] + ": out of range, " +
                                     std::to_string(size[axis]) + ", allowed: 1 to " +
                                     std::to_string(kMaxVolumeSide));
        cells *= std::uint64_t(size[axis]);
    }
    if (cells > kMaxVolumeCells)
        return Status::limit(where + ": size: too many voxels, " + std::to_string(cells) +
                             ", allowed: at most " + std::to_string(kMaxVolumeCells));
    return Status::ok();
}

std::string voxel_name(const std::array<int, 3>& size, std::uint64_t index) {
    const std::uint64_t nx = std::uint64_t(size[0]), ny = std::uint64_t(size[1]);
    return "voxel " + std::to_string(index % nx) + ' ' + std::to_string(index / nx % ny) + ' ' +
           std::to_string(index / nx / ny) + " (index " + std::to_string(index) + ')';
}

void turn_y_up(std::array<int, 3>& size, std::array<Double3, 2>& bounds_m) {
    const auto box = bounds_m;
    size = {size[0], size[2], size[1]};
    bounds_m = {{{box[0][0], -box[1][2], box[0][1]}, {box[1][0], -box[0][2], box[1][1]}}};
}

Status permute_y_up(Volume& volume) {
    const std::size_t nx = std::size_t(volume.size[0]), ny = std::size_t(volume.size[1]),
                      nz = std::size_t(volume.size[2]);
    Buffer<float> turned;
    PILEUS_TRY(turned.resize(std::uint64_t(nx) * ny * nz, "density grid, turned"));

    // Copy whole rows along x: file row (y, z) becomes row (nz-1-z, y).
    for (std::size_t z = 0; z < nz; ++z)
        for (std::size_t y = 0; y < ny; ++y) {
            const float* from = volume.density.data() + (z * ny + y) * nx;
            float* to = turned.data() + (y * nz + (nz - 1 - z)) * nx;
            std::memcpy(to, from, nx * sizeof(float));
        }
    volume.density.swap(turned);
    turn_y_up(volume.size, volume.bounds_m);
    return Status::ok();
}

namespace {

/// The row by the medium's word or else the path's extension; kBadInput if unknown.
Status find_format(const MediumSettings& medium, const std::string& path,
                   const VolumeFormat*& format) {
    format = medium.source.format.empty() ? volume_format_of(path)
                                          : volume_format_named(medium.source.format);
    if (format != nullptr) return Status::ok();
    const std::string word =
        medium.source.format.empty() ? file_extension(path) : medium.source.format;
    return Status::bad_input(path + ": format: unknown, \"" + word +
                             "\", allowed: " + volume_format_names());
}

}  // namespace

Status read_volume(const MediumSettings& medium, const std::string& path, Volume& volume,
                   WeatherFiles* files) {
    if (files != nullptr && is_weather_format(medium.source.format)) {
        const NcFile* file = nullptr;
        PILEUS_TRY(files->open(path, file));
        return weather_volume(medium, *file, volume);
    }
    const VolumeFormat* format = nullptr;
    PILEUS_TRY(find_format(medium, path, format));
    return format->read(medium, path, volume);
}

Status read_volume_head(const MediumSettings& medium, const std::string& path, VolumeHead& head,
                        WeatherFiles* files) {
    if (files != nullptr && is_weather_format(medium.source.format)) {
        const NcFile* file = nullptr;
        PILEUS_TRY(files->open(path, file));
        return weather_head(medium, *file, head);
    }
    const VolumeFormat* format = nullptr;
    PILEUS_TRY(find_format(medium, path, format));
    return format->read_head(medium, path, head);
}

}  // namespace pileus
