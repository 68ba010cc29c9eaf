// SPDX-License-Identifier: Apache-2.0
// Spectra of sun, air and ozone, and what linear sRGB makes of them.
// in: wavelengths -> out: weights of 36 bins, coefficients, shares of a published standard.
// Sun: ASTM G173-03, averaged over bins of 11.75 nm from 360 nm on, W / (m^2 nm). Observer: CIE
// 1931 by Wyman, Sloan & Shirley 2013. Air: Hansen & Travis 1974. Ozone: Serdyuchenko et al. 2014
// at 223 K, every 10 nm.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "src/world/atmosphere/air.h"

namespace air_test {

struct Bin {
    double nm;
    double weight[3];  ///< shares of R G B, whose sums are 1
};

inline double bell(double x, double middle, double left, double right) {
    const double t = (x - middle) * (x < middle ? left : right);
    return std::exp(-0.5 * t * t);
}

inline std::vector<Bin> spectrum() {
    constexpr double kSun[36] = {
        1.13419, 1.09801, 1.03541, 1.45086, 1.72453, 1.654,   1.70536, 1.97393, 2.03543,
        2.00643, 1.95531, 1.95426, 1.92438, 1.82092, 1.88517, 1.85545, 1.85083, 1.82758,
        1.84475, 1.78771, 1.76683, 1.70858, 1.68278, 1.63849, 1.59608, 1.52211, 1.52468,
        1.47836, 1.4485,  1.40522, 1.35526, 1.32788, 1.28834, 1.26938, 1.23241, 1.20345};
    constexpr double kToRgb[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                     {-0.9692660, 1.8760108, 0.0415560},
                                     {0.0556434, -0.2040259, 1.0572252}};
    std::vector<Bin> bins;
    double sum[3] = {};
    for (int i = 0; i < 36; ++i) {
        const double l = 360 + (i + 0.5) * 11.75;
        const double x = 0.362 * bell(l, 442.0, 0.0624, 0.0374) +
                         1.056 * bell(l, 599.8, 0.0264, 0.0323) -
                         0.065 * bell(l, 501.1, 0.0490, 0.0382);
        const double y =
            0.821 * bell(l, 568.8, 0.0213, 0.0247) + 0.286 * bell(l, 530.9, 0.0613, 0.0322);
        const double z =
            1.217 * bell(l, 437.0, 0.0845, 0.0278) + 0.681 * bell(l, 459.0, 0.0385, 0.0725);
        Bin bin{l, {}};
        for (int c = 0; c < 3; ++c) {
            bin.weight[c] = kSun[i] * (kToRgb[c][0] * x + kToRgb[c][1] * y + kToRgb[c][2] * z);
            sum[c] += bin.weight[c];
        }
        bins.push_back(bin);
    }
    for (Bin& bin : bins)
        for (int c = 0; c < 3; ++c) bin.weight[c] /= sum[c];
    return bins;
}

/// Between values `step` nm apart.
inline double between(const double* values, int count, double first, double step, double nm) {
    const double t = std::min(std::max((nm - first) / step, 0.0), count - 1.001);
    const int i = int(t);
    return values[i] + (values[i + 1] - values[i]) * (t - i);
}

/// Puts a wavelength into one of an air's channels, with the haze of a turbidity.
inline void set_channel(double nm, double turbidity, int channel, pileus::Air& air) {
    constexpr double kOzone[48] = {
        1.18e-27,  2.182e-28, 2.818e-28, 6.636e-28, 1.527e-27, 2.763e-27, 5.52e-27,  8.451e-27,
        1.582e-26, 2.316e-26, 3.669e-26, 4.924e-26, 7.752e-26, 9.016e-26, 1.48e-25,  1.602e-25,
        2.139e-25, 2.755e-25, 3.091e-25, 3.5e-25,   4.266e-25, 4.672e-25, 4.398e-25, 4.701e-25,
        5.019e-25, 4.305e-25, 3.74e-25,  3.215e-25, 2.662e-25, 2.238e-25, 1.852e-25, 1.473e-25,
        1.209e-25, 9.423e-26, 7.455e-26, 6.566e-26, 5.105e-26, 4.15e-26,  4.228e-26, 3.237e-26,
        2.451e-26, 2.801e-26, 2.534e-26, 1.624e-26, 1.465e-26, 2.078e-26, 1.383e-26, 7.105e-27};
    const double u = nm / 1000, u4 = u * u * u * u;
    const double depth = 0.008569 / u4 * (1 + 0.0113 / (u * u) + 0.00013 / u4);
    const double haze = 0.0972 * (turbidity - 1) * std::pow(nm / 550, -1.3);
    air.rayleigh[channel] = float(depth / double(pileus::kAirScaleKm));
    air.haze_all[channel] = float(haze / double(pileus::kHazeScaleKm));
    air.haze[channel] = float(0.93 * haze / double(pileus::kHazeScaleKm));
    // 300 Dobson units, over 15 km.
    air.ozone[channel] = float(between(kOzone, 48, 360, 10, nm) * 300 * 2.687e20 / 15);
}

/// ASTM G173-03: direct spectrum over that above the air, every 20 nm from 400.
inline double astm_direct(double nm) {
    constexpr double kShare[16] = {0.4974, 0.5533, 0.6007, 0.6404, 0.6685, 0.6989, 0.7177, 0.7276,
                                   0.7345, 0.7336, 0.7502, 0.7773, 0.8036, 0.8131, 0.8467, 0.8183};
    return between(kShare, 16, 400, 20, nm);
}

}  // namespace air_test
