// SPDX-License-Identifier: Apache-2.0
// The sky around an observer at any height, from the ground to orbit.
// in: AirTables, where the sun stands -> out: radiance by direction, the sun's irradiance.
// Hillaire 2020, sky view; docs/atmosphere.md.
#pragma once
#include <array>

#include "src/base/buffer.h"
#include "src/world/atmosphere/air_tables.h"

namespace pileus {

/// Light of the sky along one ray: what haze scattered once stands apart, without its phase
/// function, which is steep around the sun. In shares of the sun's irradiance above the air.
struct AirLight {
    float smooth[3];  ///< per sr
    float haze[3];    ///< times haze_phase: per sr
    float left[3];    ///< transmittance to the ray's end
};

/// From `height_km` up to `most_km` along the ray, or where the air or the earth ends it; the lit
/// earth is part of it where the ray meets it. `cosine` to the vertical, `along` to the sun, `sun`
/// between the sun and the vertical.
AirLight air_light(const AirTables& tables, double height_km, double cosine, double sun,
                   double along, double most_km, int steps);

constexpr int kSkyUps = 64, kSkyDowns = 32, kSkyTurns = 33;

/// Radiances all around one place. Row: kSkyDowns from straight down to the horizon, kSkyUps from
/// there to straight up, both close around the horizon; column: from the sun's side to the other.
struct AirSky {
    double height_km = 0;
    float sun = 0;      ///< cosine between the sun and the vertical
    float horizon = 0;  ///< cosine of the horizon to the vertical; below 0 up in the air
    float haze_g = 0;
    Buffer<float> texels;  ///< [row][column][smooth R G B, haze R G B, 0, 0]
};

Status make_air_sky(const AirTables& tables, double height_km, double sun_cosine, int threads,
                    AirSky& view);

/// Of a direction with this cosine to the vertical and to the sun.
void sky_radiance(const AirSky& view, double cosine, double along, float (&radiance)[3]);

/// Shares of the sun's irradiance that reach a place, on a plane facing it.
std::array<double, 3> sunlight(const AirTables& tables, double height_km, double sun_cosine);

}  // namespace pileus
