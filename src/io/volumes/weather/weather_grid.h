// SPDX-License-Identifier: Apache-2.0
// From columns of cloud to the grid of a medium, once and conserving.
// in: layers of every footprint -> out: extinction of equal cells; sums over the footprints.
// docs/weather.md, "What is conserved"
#pragma once
#include <array>

#include "src/base/vectors.h"
#include "src/io/volumes/weather/weather_source.h"

namespace pileus {

// Columns of cloud: layers with faces in metres, water and extinction.

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

/// Sums over all columns of a file, as it is laid: nothing of the grid enters.
struct WeatherSurvey {
    WeatherCounts counts;
    bool any_cloud = false;            ///< anything that is seen
    double low_m = 0, high_m = 0;      ///< faces of the cloud, or of all levels without any
    double thickness_m = 0;            ///< of layers with cloud, added up
    std::uint64_t cloudy = 0;          ///< layers with cloud
    double area_m2 = 0;                ///< of all footprints
    double liquid_kg = 0, ice_kg = 0;  ///< in all footprints
    double depth_m2 = 0;               ///< optical depth times area
    double most_depth = 0;             ///< of one column
    double most_extinction = 0;        ///< of one layer, 1/m
};

/// Equal cells over the footprints.
struct WeatherGrid {
    std::array<int, 3> size{1, 1, 1};
    double low[3] = {}, high[3] = {};  ///< metres, heights as they are
    double step(std::size_t a) const { return (high[a] - low[a]) / size[a]; }
    std::uint64_t cells() const {
        return std::uint64_t(size[0]) * std::uint64_t(size[1]) * std::uint64_t(size[2]);
    }
};

/// One pass over the file. All of the water missing: kBadInput.
Status survey_weather(const WeatherSource& source, WeatherSurvey& survey);
/// The same with room for blocks that is used again.
Status survey_weather(const WeatherSource& source, CloudLayers& layers, WeatherSurvey& survey);

/// The scene's cells, or as many as there are footprints and, along z, as the cloudy layers are
/// thick on the mean, thinner where that is more than two optical depths. `where` opens the line
/// of a size beyond the limits.
Status weather_grid(const WeatherSource& source, const WeatherSurvey& survey,
                    const std::array<int, 3>& resolution, WeatherGrid& grid);

/// Adds the layers of a block of rows: to each cell extinction times the thickness and the shares
/// of the cell's length and width that it has in common with a layer. `sums` has the grid's cells.
/// Of a variable of any kind its values instead, and to `known` the shares of the cells that have
/// one; otherwise that is empty.
void lay_block(const WeatherSource& source, const WeatherGrid& grid, std::uint64_t first_row,
               std::uint64_t rows, const CloudLayers& layers, Span<double> sums,
               Span<double> known);

}  // namespace pileus
