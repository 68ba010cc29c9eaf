// SPDX-License-Identifier: Apache-2.0
// Rays to their ends: a march ends where no one would see what lies behind, data do not.
// in: planes of such a march, the same march without light and end -> out: their data.
// docs/formats.md, "Pictures out".
#pragma once
#include <functional>

#include "src/picture/layers.h"

namespace pileus {

struct RayEnds {
    double stop_below = 0;  ///< transmittance below which rays end
    bool thinned = false;   ///< not every pixel has a ray of its own
};

/// A host's pictures have no march of their own for data: its rays go on to where half is left,
/// which is their depth.
inline double host_stop(double stop_below) { return stop_below < 0.5 ? stop_below : 0.5; }

/// Whether a picture needs more than what such rays saw: its layers of optical depth and
/// transmittance do; alpha, which no layer changes, does where it could be off by more than 1e-4;
/// depth where rays end before it.
bool follows_rays(const OutputSettings& output, const RayEnds& ends);

/// Numbers a pixel that this takes.
std::uint64_t whole_ray_planes(const OutputSettings& output, const RayEnds& ends, bool depth);

/// Marches rays that ended, of thinned pictures all, to their ends, and takes their data into
/// `planes`: `through`, and half and optical depth where there are planes for it. `march` fills
/// what has room in the planes it is given, up to their opaque depth; its colours are lost.
/// kLimit: out of memory.
Status follow_rays(const OutputSettings& output, const RayEnds& ends,
                   const std::function<Status(Planes&)>& march, Planes& planes);

}  // namespace pileus
