// SPDX-License-Identifier: Apache-2.0
// Clear air around a round earth: what scatters and absorbs at a height, in three bands.
// in: turbidity, the ground's albedo -> out: coefficients of air, haze and ozone.
// docs/atmosphere.md has the sources; Hillaire 2020 the model.
#pragma once
#include "kernels_cpu/display/level_air.h"

namespace pileus {

constexpr double kEarthRadiusKm = 6371, kAirTopKm = 6471;

/// Coefficients where the density is 1, per km, of the bands R, G, B: linear sRGB in which the sun
/// above the air is white.
struct Air {
    float rayleigh[3];  ///< all of it scattered
    float haze[3];      ///< scattered
    float haze_all[3];  ///< scattered and absorbed
    float ozone[3];     ///< absorbed
    float haze_g;       ///< mean cosine of the haze's phase function (Henyey-Greenstein)
    float ground;       ///< albedo of the round earth
};

/// Turbidity in [1, 10]: optical depth of air and haze over that of air, at 550 nm.
Air make_air(double turbidity, double ground_albedo);

/// Per steradian, of the cosine between the ways of light before and after.
float air_phase(float cosine);
float haze_phase(float g, float cosine);

}  // namespace pileus
