// SPDX-License-Identifier: Apache-2.0
// Fields of a block of rows, and the air of one of its columns.
// in: a source and rows of it -> out: heights of faces, the air's density and humidity, from below.
// docs/weather.md, "Heights", "From water to extinction"
#pragma once
#include "src/io/volumes/weather/weather_source.h"

namespace pileus {

/// All fields that a source has, of some rows of columns.
struct FieldBlock {
    const WeatherSource* source = nullptr;
    std::uint64_t first_row = 0, rows = 0;
    FieldRoom* room = nullptr;

    Status read(const WeatherSource& from, std::uint64_t row, std::uint64_t count, FieldRoom& to);
    const Buffer<double>& of(Role role) const { return room->values[std::size_t(role)]; }
    std::size_t columns() const { return std::size_t(rows) * source->row_columns(); }
    /// "file: variable q: row 1, column 2: line".
    Status fault(Role role, std::size_t column, const std::string& line) const;
};

/// The air of one column after the other. `density` and `humidity` (kg per kg of moist air) are set
/// only where water is a ratio or pressures tell the heights.
class WeatherAirColumn {
public:
    WeatherAirColumn(const FieldBlock& block, WeatherCounts& counts);

    /// Whether the file has what is needed.
    Status check() const;
    /// Whether one of the fields of air has no value in a column.
    bool lacks_values(std::size_t c) const;
    /// Heights of the faces of column `c`; kBadInput for air that is none.
    Status place_column(std::size_t c, const Span<double>& faces);

    std::vector<double> density, humidity;

private:
    const Buffer<double>& of(Role role) const { return block_.of(role); }
    bool by_pressure() const;
    Status fault(Role role, std::size_t c, const std::string& line) const {
        return block_.fault(role, c, line);
    }
    Status on_levels(Role role, std::size_t c, std::vector<double>& to);
    Status monotonic(Role role, std::size_t c, Span<const double> values, bool ascends) const;
    Status pressure_faces(std::size_t c);
    Status heights(std::size_t c, std::vector<double>& to) const;
    Status air_column(std::size_t c);

    const FieldBlock& block_;
    const WeatherSource& s_;
    WeatherCounts& counts_;
    std::size_t n_;
    bool needs_air_ = false;
    double ground_pa_ = -1;  ///< of the column; below 0: not known
    std::vector<double> kelvin_, virtual_, pressure_, faces_pa_;
    std::vector<double> logarithms_;  ///< of each layer's pressures
};

}  // namespace pileus
