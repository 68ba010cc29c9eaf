// SPDX-License-Identifier: Apache-2.0
// Layers of air in one column.
// in: numbers of one column -> out: see weather_levels.h.
// docs/weather.md, "Heights"
#include "src/io/volumes/weather/weather_levels.h"

#include <cmath>

#include "src/base/powers.h"

namespace pileus {
namespace {
constexpr double kLogOf2 = 0.69314718055994530942;
}

double logarithm(double x) { return log2_of(x) * kLogOf2; }

double temperature_of(double potential, double pressure) {
    return potential * power_of(pressure / 1e5, kKappaAir);
}

void faces_midway(Span<const double> levels, Span<double> faces) {
    const std::size_t n = levels.size;
    if (n == 1) {
        faces.at(0) = faces.at(1) = levels.at(0);
        return;
    }
    for (std::size_t k = 1; k < n; ++k) faces.at(k) = 0.5 * (levels.at(k - 1) + levels.at(k));
    faces.at(0) = 2 * levels.at(0) - faces.at(1);
    faces.at(n) = 2 * levels.at(n - 1) - faces.at(n - 1);
}

void faces_in_logarithm(Span<const double> levels, Span<double> faces) {
    const std::size_t n = levels.size;
    if (n == 1) {
        faces.at(0) = faces.at(1) = levels.at(0);
        return;
    }
    for (std::size_t k = 1; k < n; ++k) faces.at(k) = std::sqrt(levels.at(k - 1) * levels.at(k));
    faces.at(0) = levels.at(0) * levels.at(0) / faces.at(1);
    faces.at(n) = levels.at(n - 1) * levels.at(n - 1) / faces.at(n - 1);
}

double layer_logarithm(double low, double high) {
    if (!(high > 0)) return kLogOf2;
    return low > high ? logarithm(low / high) : 0;
}

double layer_pressure(double low, double high, double logarithm) {
    // Of layers so thin that the quotient is rounding alone the middle is as good.
    if (high > 0 && low - high < 1e-6 * low) return 0.5 * (low + high);
    return (low - high) / logarithm;
}

void sum_heights(Span<const double> logarithms, Span<const double> virtual_kelvin, double lowest,
                 Span<double> heights) {
    heights.at(0) = lowest;
    for (std::size_t k = 0; k < virtual_kelvin.size; ++k)
        heights.at(k + 1) =
            heights.at(k) + kDryAir * virtual_kelvin.at(k) / kGravity * logarithms.at(k);
}

double standard_height(double pressure) {
    return 44330.77 * (1 - power_of(pressure / 101325, 0.190263));
}

}  // namespace pileus
