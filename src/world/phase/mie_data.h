// SPDX-License-Identifier: Apache-2.0
// Phase functions of water clouds at 0.55 um by Lorenz-Mie theory, computed ahead of the build.
// in: nothing -> out: radii, angles, densities in a short form.
// docs/phase.md, "Mie"; tools/tables/mie.cpp writes mie_data.cpp from lab/mie/mie.h.
#pragma once
#include <cstdint>

namespace pileus {

constexpr int kMieRadii = 10, kMieAngles = 527;

/// Effective radii, um, ascending; effective variance of the sizes 0.1.
extern const float kMieRadius[kMieRadii];
/// Extinction over the area of the disks.
extern const float kMieExtinction[kMieRadii];
/// Hundredths of a degree, 0 to 18000.
extern const std::uint16_t kMieAngle[kMieAngles];
/// Densities in 1/sr: five bits e and eleven bits m for (1 + m/2048) 2^(e - 12).
extern const std::uint16_t kMieDensity[kMieRadii][kMieAngles];

/// A stored density, 1/sr. Exact in double.
inline double mie_density(std::uint16_t stored) {
    const std::uint32_t power = std::uint32_t{1} << (stored >> 11);
    return (1.0 + double(stored & 2047) / 2048.0) * double(power) / 4096.0;
}

/// The nearest stored form of a density in [2^-12, 2^19], 1/sr.
inline std::uint16_t mie_stored(double density) {
    int e = 0;
    double mantissa = density * 4096.0;
    for (; mantissa >= 2 - 0.5 / 2048 && e < 31; ++e) mantissa *= 0.5;
    const int m = int((mantissa - 1) * 2048 + 0.5);
    return std::uint16_t(e * 2048 + (m < 0 ? 0 : m > 2047 ? 2047 : m));
}

}  // namespace pileus
