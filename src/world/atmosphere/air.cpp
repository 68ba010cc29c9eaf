// SPDX-License-Identifier: Apache-2.0
// See air.h.
#include "src/world/atmosphere/air.h"

namespace pileus {
namespace {

// Optical depths of the whole column, straight up, in three bands: spectra weighed by the sun above
// the air (ASTM G173), the CIE 1931 observer and the primaries of sRGB. They hold for 0.5 to 10
// columns within 5 %, for up to 3 within 1 % (docs/atmosphere.md).
constexpr double kRayleighDepth[3] = {0.0505, 0.0998, 0.2365};  // Hansen & Travis 1974
constexpr double kOzoneDepth[3] = {0.0374, 0.0268, 0.0};        // 300 Dobson units
// Haze of optical depth 1 at 550 nm, Angstrom exponent 1.3.
constexpr double kHazeDepth[3] = {0.820, 1.011, 1.330};
constexpr double kRayleighDepth550 = 0.0972;
constexpr double kHazeAlbedo = 0.93;

}  // namespace

Air make_air(double turbidity, double ground_albedo) {
    Air air{};
    const double haze = kRayleighDepth550 * (turbidity - 1);
    for (int c = 0; c < 3; ++c) {
        air.rayleigh[c] = float(kRayleighDepth[c] / double(kAirScaleKm));
        air.haze_all[c] = float(haze * kHazeDepth[c] / double(kHazeScaleKm));
        air.haze[c] = float(kHazeAlbedo * haze * kHazeDepth[c] / double(kHazeScaleKm));
        air.ozone[c] = float(kOzoneDepth[c] / double(kOzoneHalfKm));
    }
    air.haze_g = 0.72f;
    air.ground = float(ground_albedo);
    return air;
}

float air_phase(float cosine) { return 0.0596831036594607f * (1 + cosine * cosine); }

float haze_phase(float g, float cosine) {
    const float d = 1 + g * g - 2 * g * cosine;
    return kInvFourPi * (1 - g * g) / (d * sqrt_(d));
}

}  // namespace pileus
