// SPDX-License-Identifier: Apache-2.0
// Grids of extinction or density on x, y, z in metres, as `pileus convert` writes them to NetCDF.
// in: a Volume -> out: a classic file with CF attributes; and back, bit for bit.
// docs/formats.md, "NetCDF"
#pragma once
#include "src/io/netcdf/netcdf_file.h"
#include "src/io/volumes/volume.h"
#include "src/scene/scene.h"

namespace pileus {

/// The variable of a file that is such a grid: three dimensions and the name extinction or density.
/// Null: there is none, or the scene names variables, so that it is weather data.
const NcVariable* netcdf_grid(const NcHead& head, const WeatherSettings& settings);

/// Cells and box. kBadInput: another order of dimensions, coordinates that are not in metres,
/// rising and evenly spaced, or keys of weather data; kLimit: too many cells.
Status netcdf_grid_head(const MediumSettings& medium, const NcFile& file, const NcVariable& grid,
                        VolumeHead& head);

/// The same with its values, which are finite and not negative: else kBadInput.
Status read_netcdf_grid(const MediumSettings& medium, const NcFile& file, const NcVariable& grid,
                        Volume& volume);

/// Writes a volume; faults of write_file, and kLimit: memory.
Status write_netcdf_volume(const std::string& path, const Volume& volume);
Status encode_netcdf_volume(const Volume& volume, Buffer<char>& bytes);

}  // namespace pileus
