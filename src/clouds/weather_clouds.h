// SPDX-License-Identifier: Apache-2.0
// Clouds, haze and rain of a report of the weather, as a scene would have them.
// in: a scene with [weather] -> out: kinds, layers and scatters beside its own, turbidity, time.
// docs/metar.md
#pragma once
#include <string>
#include <vector>

#include "src/base/status.h"
#include "src/scene/scene.h"

namespace pileus {

/// Nothing without a report. Where not null, `notes`: a line for each thing that was assumed or
/// left out; `unknown`: one for each group that is not understood. kBadInput: a report that cannot
/// be read; more layers or kinds than a sky may have.
Status apply_weather(Scene& scene, std::vector<std::string>* notes = nullptr,
                     std::vector<std::string>* unknown = nullptr);

}  // namespace pileus
