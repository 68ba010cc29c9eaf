// SPDX-License-Identifier: Apache-2.0
// Settings of method collectors.
// in: keys of [method.collectors] -> out: plain values. docs/scene.md
#pragma once
#include <cstdint>

#include "src/scene/methods/thin_settings.h"

namespace pileus {

/// Where collectors stand.
struct CollectorPlacement {
    int samples = 20'000;
    bool rejection_sampler = false;  ///< sampler = "rejection" (paper) or "stratified"
    bool variance_field = false;     ///< placement = "variance" or "gradient"
    int variance_radius = 2;         ///< voxels, 1..8
    double density_range = 0.1;      ///< stop splitting below this range of density; [0, 1]
    double influence_radius = 0.05;  ///< of a sample, as a share of the box's diagonal; (0, 1]
};

/// What a collector keeps of its light.
struct CollectorClosure {
    bool lobe = false;    ///< closure = "lobe"
    bool camera = false;  ///< closure = "camera": cells lit towards a fixed camera
    int cell_voxels = 2;  ///< edge of such a cell, voxels; 1..64
    int bands = 4;        ///< 1..8
    int axis_degrees = 8;
    bool window = false;  ///< sinc window against ringing
};

/// How lit collectors become a picture.
struct CollectorDisplay {
    bool billboards = false;      ///< display = "billboards"
    double radius_factor = 1.35;  ///< billboard radius over r; best only; [1, 3]
    Compositor compositor = Compositor::kBuiltin;
    bool guided_nodes = false;  ///< node_filter = "guided" or "surroundings"
    NodeDirections directions = NodeDirections::kNear;
};

struct CollectorSettings {
    std::int64_t photons = 5'000'000;  ///< over the whole ring
    int generations = 50;
    bool paper = false;  ///< variant = "paper"
    bool local_tracking = true;
    double peak_deg = 12;  ///< scatterings within it are the sun's own light; [0, 90]
    bool first_order_split = true;
    CollectorPlacement placement;
    CollectorClosure closure;
    CollectorDisplay display;
    UpsampleSettings thin;
    int light_refresh = 1;  ///< frames in which sunlight on nodes follows a sun that moves; 1..64
    AccumulationChoice accumulation = AccumulationChoice::kAuto;
};

}  // namespace pileus
