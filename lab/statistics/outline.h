// SPDX-License-Identifier: Apache-2.0
// How crooked outlines are: lengths of contours at several cell sizes, and fractal dimensions.
// in: a plane of numbers -> out: lengths in cells, dimensions.
// docs/generators.md, "Measured"; Mandelbrot 1982; Lovejoy 1982, Science 216.
#pragma once
#include <vector>

namespace pileus {

/// Numbers of nx x ny cells, x fastest; 0 beside them.
struct Plane {
    int nx = 0, ny = 0;
    std::vector<double> value;

    Plane() = default;
    Plane(int x, int y) : nx(x), ny(y), value(std::size_t(x) * std::size_t(y)) {}
    double at(int x, int y) const {
        return x < 0 || y < 0 || x >= nx || y >= ny
                   ? 0
                   : value[std::size_t(y) * std::size_t(nx) + std::size_t(x)];
    }
    double& cell(int x, int y) { return value[std::size_t(y) * std::size_t(nx) + std::size_t(x)]; }
};

/// Euclidean length in cells of the contour at `level` > 0, by marching squares between the middles
/// of cells.
double contour_length(const Plane& plane, double level);

/// Means over b x b cells, the first block beginning at (-x, -y), 0 <= x, y < b.
Plane block_means(const Plane& plane, int b, int x, int y);

/// Dimension of the outline {value > threshold}: of min(value/threshold, 4), averaged over 1, 2, 4
/// and 8 cells, the length of the contour at 1 falls as (cells)^(1 - D). Least squares in
/// logarithms; NaN where there is no outline. A disc has 1.00, a Koch curve 1.26.
double outline_dimension(const Plane& plane, double threshold);

/// The areas in cells and lengths of outline of connected parts of {value > threshold} that do not
/// reach the rim.
struct Patch {
    double area = 0, length = 0;
};
std::vector<Patch> patches(const Plane& plane, double threshold);

/// Dimension of many outlines by length ~ area^(D/2), of patches with `least` cells and more; NaN
/// for fewer than three.
double perimeter_area_dimension(const std::vector<Patch>& patches, double least = 12);

/// Slope of the least squares line through (x, y); NaN for fewer than two points.
double fitted_slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace pileus
