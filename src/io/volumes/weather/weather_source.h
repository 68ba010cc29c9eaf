// SPDX-License-Identifier: Apache-2.0
// An opened file of weather data: what is where in it, and blocks of columns from it.
// in: an NcFile and the scene's words -> out: axes, fields, places; values in SI units, from below.
// docs/weather.md
#pragma once
#include "src/base/buffer.h"
#include "src/io/volumes/weather/weather_fields.h"
#include "src/io/volumes/weather/weather_ground.h"
#include "src/scene/media/transfer.h"

namespace pileus {

/// What tells where the layers of air lie.
enum class Vertical { kHeightFaces, kHeightLevels, kPressureFaces, kPressureLevels };

/// Accidents of the data that are no faults, counted.
struct WeatherCounts {
    std::uint64_t missing = 0;  ///< missing values of what is shown, taken for no cloud
    std::uint64_t clamped = 0;  ///< negative water within -1e-6 kg/kg, taken for none
    std::uint64_t values = 0;   ///< of what is shown
    std::uint64_t filled = 0;   ///< missing values of air, taken from the next level
    std::uint64_t blank = 0;    ///< columns without a value, taken for clear
    std::uint64_t capped = 0;   ///< cells with more water than their cloud fraction tells
};

struct WeatherSource {
    const NcFile* file = nullptr;
    const WeatherSettings* settings = nullptr;
    const NcVariable* water = nullptr;                   ///< or what is shown in its place
    const std::vector<TransferRow>* transfer = nullptr;  ///< of what is shown; null: none
    WeatherAxes axes;
    WeatherFields fields;
    Vertical vertical = Vertical::kHeightLevels;
    /// Of hybrid levels: pressure = a + b * pressure at the ground, or height = a + b * that of the
    /// ground, from the file's first level on.
    std::vector<double> hybrid_a, hybrid_b;
    bool hybrid_heights = false;
    bool top_down = false;  ///< the file's first level is the highest
    Footprints ground;

    std::size_t levels() const { return std::size_t(axes.levels); }
    std::size_t row_columns() const { return std::size_t(axes.nx); }
    bool has(Role role) const { return fields[role].there(); }
    /// What is seen of a layer's value: of water its extinction. 0: nothing.
    double seen(double value) const {
        if (value != value) return 0;
        return has(Role::kShown) && transfer != nullptr ? transfer_extinction(*transfer, value)
                                                        : value;
    }
};

/// Room for the values of fields and for one as it stands in the file.
struct FieldRoom {
    Buffer<double> values[std::size_t(Role::kCount)], raw;
};

/// All but values. Faults of the data and of names: kBadInput.
Status open_weather(const NcFile& file, const WeatherSettings& settings, WeatherSource& source);

/// Rows of a field: values[(row * nx + column) * n + level], n levels from below, those that are
/// missing as NaN. n: levels, one more on faces, 1 at the ground.
Status read_field(const WeatherSource& source, Role role, std::uint64_t first_row,
                  std::uint64_t rows, Buffer<double>& values);
/// The same with room that is used again where it is as large.
Status read_field(const WeatherSource& source, Role role, std::uint64_t first_row,
                  std::uint64_t rows, Buffer<double>& raw, Buffer<double>& values);

/// Room for at least so many values, which may be that of before.
Status make_room(std::uint64_t count, const char* what, Buffer<double>& room);

/// Sets `top_down` and the coefficients of hybrid levels, and chooses what tells the heights.
Status find_vertical(WeatherSource& source);

/// "column 3 4" of a grid, "column 12" of a list.
std::string column_name(const WeatherSource& source, std::uint64_t row, std::size_t column);

}  // namespace pileus
