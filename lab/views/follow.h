// SPDX-License-Identifier: Apache-2.0
// One photon of a scene from its light to its end, to read and to check.
// in: Scene, the number of a light and of a photon -> out: its events in world metres.
// docs/how-it-works.md
#pragma once
#include "lab/views/follow_photon.h"
#include "src/session/render.h"

namespace pileus {

/// A photon's way. Positions are the world's, in metres.
struct PhotonWay {
    std::string light;
    std::vector<PathPoint> points;  ///< at most kMaxWayPoints, the last always
};
constexpr std::size_t kMaxWayPoints = 100000;

/// Follows photon `number` of the first generation of light `light` (0: the first that the plan
/// names). Errors: kBadInput (scene, files, isa, no such light or photon), kLimit (memory), kIo.
Status follow(const Scene& scene, const RenderOptions& options, int light, std::uint32_t number,
              PhotonWay& way);

}  // namespace pileus
