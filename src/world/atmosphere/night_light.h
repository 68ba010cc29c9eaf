// SPDX-License-Identifier: Apache-2.0
// Which of sun and moon lights a scene, and what else shines at night.
// in: settings, sun, night, the air -> out: the lights of the air, radiance from behind it.
// docs/atmosphere.md, "Night"
#pragma once
#include "src/world/atmosphere/atmosphere.h"

namespace pileus {

/// Fills the air's lights. The moon is the first where more of its light than of the sun's
/// reaches the media; over a level ground neither has any below 0 degrees. The other's sky counts
/// where it lights level ground with a thousandth of what the first's and the glow do.
void choose_light(const AtmosphereSettings& settings, const Sun& sun, const Night& night,
                  bool ground, Atmosphere& air);

/// What comes of a wide even light behind the air, in a direction with this cosine to the vertical:
/// half of what the air takes it scatters in again, for light is all around it but from below. 0
/// towards the earth.
std::array<double, 3> wide_left(const AirTables& tables, double height_km, double cosine);

/// The same of a layer that glows evenly, 90 km up, of 1 straight up: longer ways through it. 0
/// above the layer.
std::array<double, 3> glow_at(const AirTables& tables, double height_km, double cosine);

}  // namespace pileus
