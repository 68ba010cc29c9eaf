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

/// How much of an even light of 1 behind the air comes down a direction with this cosine to the
/// vertical: longer ways through the glowing layer, 90 km up, and what air leaves of it. 0 towards
/// the earth, and above the layer. Air that scatters light out of a wide light scatters as much of
/// it in, so that the root of what it leaves is taken.
std::array<double, 3> glow_at(const AirTables& tables, double height_km, double cosine);

}  // namespace pileus
