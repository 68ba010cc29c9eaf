// SPDX-License-Identifier: Apache-2.0
// Columns of cloud: layers with faces in metres, water and extinction.
// in: a block of rows of a file -> out: faces, extinction, from below; what was clamped or missing.
// docs/weather.md, "From water to extinction"
#pragma once
#include "src/io/volumes/weather/weather_source.h"

namespace pileus {

/// Of `rows` rows of columns: [(row * nx + column) * levels + level], faces with one more level.
struct CloudLayers {
    Buffer<double> faces_m;     ///< heights as they are
    Buffer<double> extinction;  ///< 1/m of heights as they are; or what is shown, NaN where missing
    Buffer<double> liquid, ice;  ///< kg/m3 of cloud as it is laid; empty: none of it
    /// Room of fields, kept from block to block: memory that comes and goes is never all given
    /// back.
    FieldRoom room;
};

/// Rows that are read at a time, and bytes that reading them holds at most.
std::uint64_t block_rows(const WeatherSource& source);
std::uint64_t block_bytes(const WeatherSource& source);

/// kBadInput: values that no cloud has, levels upside down or not monotonic; adds to `counts`.
Status read_layers(const WeatherSource& source, std::uint64_t first_row, std::uint64_t rows,
                   CloudLayers& layers, WeatherCounts& counts);

}  // namespace pileus
