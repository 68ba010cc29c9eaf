// SPDX-License-Identifier: Apache-2.0
// What makes a cloud look and weigh like one, of any grid of extinction.
// in: extinction in 1/m, edge lengths of cells -> out: dimensions, spectrum, water and cover by
// height. docs/generators.md, "Measured"
#pragma once
#include "lab/statistics/outline.h"
#include "src/base/span.h"

namespace pileus {

/// A grid of extinction, [z][y][x].
struct ExtinctionGrid {
    int size[3];
    double cell_m[3];
    const float* value;
    double per_m = 1;  ///< factor on the values

    double at(int x, int y, int z) const {
        return per_m * double(value[(std::size_t(z) * std::size_t(size[1]) + std::size_t(y)) *
                                        std::size_t(size[0]) +
                                    std::size_t(x)]);
    }
};

/// Optical depth along an axis, 0 to 2; the other two axes in their order are the plane's.
Plane depth_along(const ExtinctionGrid& grid, int axis);

/// Slope of the power spectrum of a plane's rows, then columns, in wavelengths from 4 cells to a
/// quarter of the row; NaN for rows under 32 cells.
double spectrum_slope(const Plane& plane, bool columns);

struct HeightRow {
    double height_m;   ///< of the layer's middle over the base
    double cover;      ///< share of cells with cloud
    double adiabatic;  ///< mean over them: extinction over adiabatic extinction, 0.18/m at 1 km
};

struct CloudStatistics {
    double dimension[3]{};  ///< of the outline in side view, mean of two sides, depth > 0.3, 1, 3
    double perimeter_area = 0;         ///< of the patches seen from above, depth > 1
    int patches = 0;                   ///< of 12 cells and more
    double spectrum = 0;               ///< mean slope of the optical depth from above along x and y
    double cover = 0;                  ///< share of columns of depth > 1
    double mean_depth = 0;             ///< mean of those columns
    double base_m = 0;                 ///< lowest cell with cloud, over the grid's floor
    std::vector<HeightRow> by_height;  ///< of every layer with cloud
};

/// Cells above `cloudy_per_m` are cloud.
CloudStatistics cloud_statistics(const ExtinctionGrid& grid, double cloudy_per_m = 0.002);

}  // namespace pileus
