// SPDX-License-Identifier: Apache-2.0
// What the kernel that turns skylight towards a camera reads and writes.
// in: nodes, a camera, shares of the sky -> out: brightness of each node and set.
// docs/raymarch.md, "Skylight"
#pragma once
#include "kernels_cpu/core/camera.h"
#include "kernels_cpu/display/march_params.h"

namespace pileus {

/// Equal parts of the sphere that nodes see apart, the lower half first: so many bands in height,
/// so many around.
constexpr int kSphereBands = 6, kSphereAround = 4, kSkyParts = kSphereBands * kSphereAround;
/// Steps of the table of what is scattered by an angle, by its cosine from -1 to 1.
constexpr int kSkyPhaseSteps = 256;

struct SkyTurnParams {
    NodeGrid grid;
    CameraParams camera;
    float reach;  ///< m; nearer nodes are seen from all sides
    float middles[kSkyParts][3];
    float share[3][kSkyParts];  ///< of each set's light from each part
    std::int32_t sets, later;   ///< later: 1 where there are numbers of octaves after the first
};

struct SkyTurnBuffers {
    const float* phase;  ///< [kSkyPhaseSteps + 1]
    const float* seen;   ///< [number][node]
    float* light;        ///< [set][node]
};

}  // namespace pileus
