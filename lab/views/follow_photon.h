// SPDX-License-Identifier: Apache-2.0
// One photon's way, event by event: the tracer's own steps with one lane.
// in: a launch and a photon's number -> out: the places where something happened to it.
// docs/how-it-works.md; kernels_cpu/photons/trace.h makes every decision, so the bits are the
// picture's.
#pragma once
#include <vector>

#include "src/photons/trace.h"

namespace pileus {

enum class PathEvent {
    kStart,    ///< on the box's silhouette or faces
    kNull,     ///< tentative collision that was none
    kScatter,  ///< turned
    kAbsorbed,
    kGround,  ///< reflected by the ground; `at_m` is where it enters the box again
    kTop,     ///< left the box through its top, bottom, sides
    kBottom,
    kSides,
    kLost,  ///< in the ground, or by the ground into the sky
    kTerminated,
};
const char* path_event_name(PathEvent event);

/// `at_m` in metres, box-local; `direction` of travel after the event; `path_m` travelled inside
/// the box so far; `order` counts scatterings and bounces so far.
struct PathPoint {
    PathEvent event = PathEvent::kStart;
    float at_m[3]{}, direction[3]{};
    float path_m = 0;
    int order = 0;
    float density_bound = 0;  ///< majorant density where a collision was tried
};

/// Follows photon `number` (of generation 0) of a light until it dies, without the light that the
/// ground owes for it. At most `most` points are kept, the last always. Deposits nothing.
void follow_photon(const TraceInput& in, const Light& light, std::uint32_t number, std::size_t most,
                   std::vector<PathPoint>& path);

}  // namespace pileus
