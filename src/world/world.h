// SPDX-License-Identifier: Apache-2.0
// What every method begins with: the scene's sky map, and a medium where there is none.
// in: a checked scene -> out: SkyMap; a box without anything in it.
// docs/architecture.md, "One way through".
#pragma once
#include "src/run/context.h"
#include "src/world/light/sky_map.h"
#include "src/world/medium/medium.h"

namespace pileus {

/// A scene without media still has a sky and a ground to show. kLimit: out of memory.
Status empty_medium(const Scene& scene, Medium& medium);

/// Reads the scene's sky map, if it has one: lights, and with them the plan, depend on its colours.
/// Errors: those of opening the file and of load_sky_map; kLimit: a file over the limit.
Status read_sky_map(const Scene& scene, const Context& context, SkyMap& map);

}  // namespace pileus
