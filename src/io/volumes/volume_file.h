// SPDX-License-Identifier: Apache-2.0
// Readers of density grids.
// in: a file of grey values -> out: a Volume whose every value is finite and >= 0.
// docs/formats.md
#pragma once
#include <array>
#include <string>

#include "src/base/span.h"
#include "src/base/status.h"
#include "src/io/netcdf/netcdf_file.h"
#include "src/io/volumes/volume.h"
#include "src/scene/number_keys.h"
#include "src/scene/scene.h"

namespace pileus {

class WeatherFiles;

constexpr int kMaxVolumeSide = int(range_of(&MediumBox::resolution).high);
constexpr std::uint64_t kMaxVolumeCells = std::uint64_t{1} << 31;

/// Reads `path` (already resolved) as medium.format says, or by extension (volume_format_of in
/// src/scene/rows/volume_format.h). Axes and box stay as in the file: the caller turns a y-up grid
/// with permute_y_up and lets a box given in the scene win. Bad settings or contents: kBadInput;
/// more cells or memory than allowed: kLimit; failed half way: kIo. `volume` is unspecified after a
/// fault.
Status read_volume(const MediumSettings& medium, const std::string& path, Volume& volume,
                   WeatherFiles* files = nullptr);

/// What read_volume would give, before its values: size, place and kind. Reads little more than
/// the head of the file; faults of the head as read_volume's, those of the values are not met.
Status read_volume_head(const MediumSettings& medium, const std::string& path, VolumeHead& head,
                        WeatherFiles* files = nullptr);

/// The text form `Volume "volumegrid" "integer nx" N ... "float density" [...]`. Axes stay in file
/// order. `point p0` and `point p1` are the outer faces of the box; both or neither must be given.
Status read_pbrt_volume(const std::string& path, Volume& volume);
Status decode_pbrt_volume(const std::string& name, Span<const char> text, Volume& volume);
Status read_pbrt_head(const std::string& path, VolumeHead& head);

/// Bare numbers, x fastest; whole numbers are scaled so that the largest becomes 1. The length
/// must be exactly that of size[0]*size[1]*size[2] values.
Status read_raw_volume(const std::string& path, RawType type, const std::array<int, 3>& size,
                       bool big_endian, Volume& volume);
Status decode_raw_volume(const std::string& name, Span<const char> bytes, RawType type,
                         const std::array<int, 3>& size, bool big_endian, Volume& volume);
Status read_raw_head(const std::string& path, RawType type, const std::array<int, 3>& size,
                     VolumeHead& head);

/// What write_raw_volume divides by: for whole numbers the largest value, of relative densities
/// only where that is above 1; otherwise 1.
double raw_scale(const Volume& volume, RawType type);

/// Writes bare numbers, x fastest. float32 keeps every bit; whole numbers hold density / raw_scale,
/// rounded to the nearest of 0..255 or 0..65535. Out of memory: kLimit; cannot write: kIo.
Status write_raw_volume(const std::string& path, RawType type, bool big_endian,
                        const Volume& volume);

/// Size and box of a grid that permute_y_up turns; mirroring an axis exchanges its two faces.
void turn_y_up(std::array<int, 3>& size, std::array<Double3, 2>& bounds_m);

/// Turns a grid whose y axis points up by +90 degrees about x: (x, y, z) -> (x, -z, y), values and
/// box alike, so that z points up and handedness is kept. Out of memory: kLimit.
Status permute_y_up(Volume& volume);

/// Checks three side lengths and their product: kBadInput for a side, kLimit for the product.
/// `where` opens the line.
Status check_volume_size(const std::string& where, const std::array<std::int64_t, 3>& size);

/// "voxel 3 4 5 (index 1234)".
std::string voxel_name(const std::array<int, 3>& size, std::uint64_t index);

// Clouds that large-eddy simulations leave as text: liquid water and droplet size.

/// Reads either text form, told apart by the first line that is no comment: commas or none. Values
/// are extinction in 1/m, 1.5 LWC / r_eff with LWC in g/m3 and r_eff in um (geometric optics,
/// Q_ext = 2). A stretched grid is laid on equal layers, keeping every column's optical depth. With
/// one level only, the place is not known. Contents at fault: kBadInput with file:line:column; more
/// voxels than a text of that length can mean, or than allowed: kLimit. `volume` is unspecified
/// after a fault.
Status read_les_volume(const std::string& path, Volume& volume);

/// The same from memory; `name` opens the lines of faults.
Status decode_les_volume(const std::string& name, Span<const char> text, Volume& volume);

/// Size, place and kind from the head lines; faults of the rows are not looked for.
Status read_les_head(const std::string& path, VolumeHead& head);

// Binary grids that Mitsuba calls "gridvolume".

/// Reads version 3, float32, one channel: a relative density. The box of the header is taken as
/// metres. The length must be exact. Anything else: kBadInput; more voxels or memory than allowed:
/// kLimit. `volume` is unspecified after a fault.
Status read_vol_volume(const std::string& path, Volume& volume);

/// The same from memory; `name` opens the lines of faults.
Status decode_vol_volume(const std::string& name, Span<const char> bytes, Volume& volume);

/// Size and box from the header; the values are not looked at.
Status read_vol_head(const std::string& path, VolumeHead& head);

// Grids on x, y, z in metres, as `pileus convert` writes them to NetCDF; and back, bit for bit.

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

// Weather data as a medium: a NetCDF file of cloud water on levels becomes extinction on a grid.
// docs/weather.md

/// Faults of the data: kBadInput, one line; more cells or memory than allowed: kLimit.
Status read_weather_volume(const MediumSettings& medium, const std::string& path, Volume& volume);
Status read_weather_head(const MediumSettings& medium, const std::string& path, VolumeHead& head);

/// The same of an open file.
Status weather_volume(const MediumSettings& medium, const NcFile& file, Volume& volume);
Status weather_head(const MediumSettings& medium, const NcFile& file, VolumeHead& head);

}  // namespace pileus
