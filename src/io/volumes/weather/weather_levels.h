// SPDX-License-Identifier: Apache-2.0
// Layers of air in one column: faces, thickness, density.
// in: pressures or heights of levels or faces, temperature, humidity, all from below -> out:
// layers. docs/weather.md, "Heights"; docs/methods.md 1.
#pragma once
#include <cstddef>

#include "src/base/span.h"

namespace pileus {

constexpr double kDryAir = 287.05;                         ///< gas constant R_d, J/(kg K)
constexpr double kGravity = 9.80665;                       ///< m/s2
constexpr double kVapourOverAir = 0.608;                   ///< R_v/R_d - 1
constexpr double kKappaAir = 0.2857142857142857;           ///< R_d/c_p
constexpr double kWaterDensity = 1000, kIceDensity = 917;  ///< kg/m3

inline double virtual_temperature(double kelvin, double humidity) {
    return kelvin * (1 + kVapourOverAir * humidity);
}

/// Natural logarithm of a positive number, without libm.
double logarithm(double x);

/// Temperature of potential temperature at a pressure in Pa, reference 1000 hPa.
double temperature_of(double potential, double pressure);

/// Faces midway between values, the outer ones mirrored; of a single value the same twice.
void faces_midway(Span<const double> levels, Span<double> faces);

/// Faces at the geometric mean of pressures, the outer ones mirrored in the logarithm.
void faces_in_logarithm(Span<const double> levels, Span<double> faces);

/// Mean pressure of a layer such that its mass is exactly (low - high)/g: (low -
/// high)/ln(low/high), as layer_logarithm gives it. The uppermost layer may end at 0 Pa; ln 2
/// stands for its logarithm then, as in the IFS.
double layer_pressure(double low, double high, double logarithm);
/// ln(low/high), ln 2 for high = 0; 0 where both are the same.
double layer_logarithm(double low, double high);

/// Heights of faces from the lowest one on: dz = R_d T_v/g ln(p_low/p_high), by the layers'
/// logarithms. `heights` has one more element.
void sum_heights(Span<const double> logarithms, Span<const double> virtual_kelvin, double lowest,
                 Span<double> heights);

/// Height of a pressure in the standard atmosphere's lowest layer.
double standard_height(double pressure);

/// Extinction of droplets, or of crystals by their effective radius, 1/m: 1.5 content / (density
/// r).
inline double radius_extinction(double content, double density, double radius) {
    return 1.5 * content / (density * radius);
}
/// Fu (1996): 4 sqrt(3)/3 content / (ice density D_ge).
inline double dge_extinction(double content, double dge) {
    return 2.3094010767585030580 * content / (kIceDensity * dge);
}

}  // namespace pileus
