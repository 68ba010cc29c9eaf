// SPDX-License-Identifier: Apache-2.0
// Settings of method photon-grid.
// in: keys of [method.photon_grid] -> out: plain values. docs/scene.md
#pragma once
#include <array>
#include <cstdint>

#include "src/scene/methods/thin_settings.h"

namespace pileus {

enum class GridClosure { kSh, kPublished, kMean, kCamera };

struct PhotonGridSettings {
    std::int64_t photons = 5'000'000;  ///< over all generations
    int generations = 16;
    bool ring = false;                  ///< an animation keeps every generation apart
    std::array<int, 3> cells{0, 0, 0};  ///< of the grid that gathers; 0: chosen
    GridClosure closure = GridClosure::kSh;
    int bands = 4;         ///< closure = "sh"; 1..8
    int axis_degrees = 8;  ///< closure = "sh"
    double peak_deg = 12;  ///< as CollectorSettings::peak_deg
    bool local_tracking = true;
    bool first_order_split = true;
    NodeDirections directions = NodeDirections::kNear;  ///< never kAll
    UpsampleSettings thin;
    int light_refresh = 1;  ///< frames in which sunlight on nodes follows a sun that moves; 1..64
    AccumulationChoice accumulation = AccumulationChoice::kAuto;
};

}  // namespace pileus
