// SPDX-License-Identifier: Apache-2.0
// Where the columns of a file stand: the edges of their footprints in metres.
// in: coordinates in degrees or metres -> out: rectangles that part the region between them.
// docs/weather.md, "Place"; sinusoidal projection.
#pragma once
#include <string>
#include <vector>

#include "src/io/volumes/weather/weather_axes.h"

namespace pileus {

constexpr double kMetresPerDegree = 40030173.0 / 360;

/// Column (i, j) covers x from row_scale[j] * x_edges[i] to row_scale[j] * x_edges[i + 1], and y
/// from y_edges[j] to y_edges[j + 1]; edges ascend.
struct Footprints {
    /// What x = y = 0 is: longitude and latitude (of a rotated pole where the file has one), or the
    /// file's own metres; degrees of longitude are `squeeze` times as wide in a slice.
    double origin[2] = {0, 0};
    bool in_degrees = false;
    double squeeze = 1;
    std::vector<double> x_edges, y_edges, row_scale;
    bool x_flipped = false, y_flipped = false;  ///< the file's first column is the largest x or y
    bool even = false;  ///< all footprints are equal: the grid of the medium may be theirs
    std::string text;   ///< "longitude and latitude, metres with the cosine", for `pileus info`

    std::size_t nx() const { return x_edges.size() - 1; }
    std::size_t ny() const { return y_edges.size() - 1; }
    double low_x() const;
    double high_x() const;
};

/// Edges midway between places, the outer ones mirrored; a single place gets `width`. Descending
/// places are turned round. False where they are not strictly monotonic. Places within 1 % of a
/// step of even ones become even.
bool edges_of(std::vector<double> places, double width, std::vector<double>& edges, bool& flipped);

/// kBadInput: no coordinates, or none that are monotonic.
Status find_footprints(const NcFile& file, const NcVariable& water, const WeatherAxes& axes,
                       const WeatherSettings& settings, Footprints& ground);

}  // namespace pileus
