// SPDX-License-Identifier: Apache-2.0
// See cloud_statistics.h.
#include "lab/statistics/cloud_statistics.h"

#include <cmath>
#include <limits>

#include "src/base/angles.h"

namespace pileus {
namespace {

/// Adds the power of one row at wave numbers 1 to n/2.
void add_power(const std::vector<double>& row, std::vector<double>& power) {
    const std::size_t n = row.size();
    std::vector<double> cosine(n), sine(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double turn = kTwoPi64 * double(i) / double(n);
        cosine[i] = std::cos(turn), sine[i] = std::sin(turn);
    }
    for (std::size_t k = 1; k <= n / 4; ++k) {
        double re = 0, im = 0;
        for (std::size_t i = 0; i < n; ++i)
            re += row[i] * cosine[i * k % n], im += row[i] * sine[i * k % n];
        power[k] += re * re + im * im;
    }
}

/// Heights, cover and water of each layer that has cloud.
void measure_layers(const ExtinctionGrid& g, double cloudy, CloudStatistics& out) {
    bool found = false;
    const double cells = double(g.size[0]) * double(g.size[1]);
    for (int z = 0; z < g.size[2]; ++z) {
        if (!found) out.base_m = z * g.cell_m[2];
        const double height = (z + 0.5) * g.cell_m[2] - out.base_m;
        const double adiabatic = 0.18 * std::pow(height / 1000, 21.0 / 32);
        double sum = 0, count = 0;
        for (int y = 0; y < g.size[1]; ++y)
            for (int x = 0; x < g.size[0]; ++x) {
                const double v = g.at(x, y, z);
                if (v > cloudy) sum += v / adiabatic, count += 1;
            }
        if (count == 0) continue;
        found = true;
        out.by_height.push_back({height, count / cells, sum / count});
    }
}

}  // namespace

Plane depth_along(const ExtinctionGrid& g, int axis) {
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    Plane out(g.size[u], g.size[v]);
    for (int z = 0; z < g.size[2]; ++z)
        for (int y = 0; y < g.size[1]; ++y)
            for (int x = 0; x < g.size[0]; ++x) {
                const int at[3] = {x, y, z};
                out.cell(at[u], at[v]) += g.at(x, y, z) * g.cell_m[axis];
            }
    return out;
}

double spectrum_slope(const Plane& p, bool columns) {
    const int n = columns ? p.ny : p.nx, rows = columns ? p.nx : p.ny;
    if (n < 32) return std::numeric_limits<double>::quiet_NaN();
    std::vector<double> row(std::size_t(n), 0.0), power(std::size_t(n), 0.0);
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < n; ++i) row[std::size_t(i)] = columns ? p.at(j, i) : p.at(i, j);
        add_power(row, power);
    }
    std::vector<double> x, y;
    // Means over bins a quarter of an octave wide, so that short waves do not outvote long ones.
    for (double low = 4; low < n / 4; low *= 1.189) {
        double sum = 0, count = 0;
        for (int k = int(std::ceil(low)); k < low * 1.189 && k <= n / 4; ++k)
            sum += power[std::size_t(k)], count += 1;
        if (count == 0 || !(sum > 0)) continue;
        x.push_back(std::log(low)), y.push_back(std::log(sum / count));
    }
    return fitted_slope(x, y);
}

CloudStatistics cloud_statistics(const ExtinctionGrid& grid, double cloudy_per_m) {
    CloudStatistics out;
    constexpr double kThresholds[] = {0.3, 1, 3};
    const Plane sides[2] = {depth_along(grid, 0), depth_along(grid, 1)};
    for (int i = 0; i < 3; ++i)
        out.dimension[i] = 0.5 * (outline_dimension(sides[0], kThresholds[i]) +
                                  outline_dimension(sides[1], kThresholds[i]));
    const Plane above = depth_along(grid, 2);
    const std::vector<Patch> parts = patches(above, 1);
    for (const Patch& part : parts) out.patches += part.area >= 12 ? 1 : 0;
    out.perimeter_area = perimeter_area_dimension(parts);
    out.spectrum = 0.5 * (spectrum_slope(above, false) + spectrum_slope(above, true));
    double count = 0;
    for (const double depth : above.value)
        if (depth > 1) out.mean_depth += depth, count += 1;
    out.cover = count / double(above.value.size());
    if (count > 0) out.mean_depth /= count;
    measure_layers(grid, cloudy_per_m, out);
    return out;
}

}  // namespace pileus
