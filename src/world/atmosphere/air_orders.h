// SPDX-License-Identifier: Apache-2.0
// Light that clear air scatters again and again, by orders.
// in: AirTables with sunlight -> out: what comes from all around at heights and suns.
// docs/atmosphere.md.
#pragma once
#include "src/world/atmosphere/air_tables.h"

namespace pileus {

/// Fills `around` and `ground` of tables that have their sunlight.
Status add_orders(int threads, AirTables& tables);

/// Where a height and a sun lie in the tables, in [0, 1]: rows close to the ground, columns close
/// around the horizon, from 21 degrees below it.
double around_row(double height_km);
double around_column(double sun_cosine);

}  // namespace pileus
