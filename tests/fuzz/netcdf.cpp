// SPDX-License-Identifier: Apache-2.0
// Fuzz target: weather data in classic NetCDF files.
// in: bytes as a .nc file -> out: a lawful volume and an equal head, or one line with its place.
// docs/formats.md; docs/weather.md
#include <cstring>

#include "src/io/netcdf/netcdf_file.h"
#include "src/io/volumes/volume_file.h"
#include "tests/fuzz/target.h"

int fuzz::netcdf(const std::uint8_t* data, std::size_t size) {
    // HDF5 is read by a library of others, which has fuzz targets of its own.
    if (size >= 4 && std::memcmp(data, "\x89HDF", 4) == 0) return 0;
    pileus::NcFile file;
    const pileus::Status opened = file.open_bytes("w.nc", fuzz::text_of(data, size));
    if (!opened) {
        fuzz::check_fault(opened, "w.nc:", true);
        return 0;
    }
    pileus::MediumSettings medium;
    medium.weather.in_cloud = size % 2 == 1;
    // A grid has its own cells.
    const bool grid = pileus::netcdf_grid(file.head(), medium.weather) != nullptr;
    if (grid) medium.weather.in_cloud = false;
    if (!grid) medium.box.resolution = {4, 3, 5};
    pileus::VolumeHead head;
    pileus::Volume volume;
    const pileus::Status seen = pileus::weather_head(medium, file, head);
    const pileus::Status status = pileus::weather_volume(medium, file, volume);
    // The head of a grid reads none of its values, which may be faults of their own.
    if (!grid || !seen)
        fuzz::require(bool(seen) == bool(status), "a head and a volume have the same faults");
    if (!status) {
        fuzz::check_fault(status, "w.nc:", true);
        return 0;
    }
    fuzz::check_volume(volume);
    fuzz::require(head.size == volume.size, "a head tells the size of the whole");
    return 0;
}
