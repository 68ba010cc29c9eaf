// SPDX-License-Identifier: Apache-2.0
// What shines behind the air in a picture's sky at night.
// in: a camera, the air as it looks through it, what is before the sky -> out: light added.
// docs/atmosphere.md, "Night"
#pragma once
#include "kernels_cpu/core/camera.h"
#include "src/base/span.h"
#include "src/world/atmosphere/atmosphere.h"

namespace pileus {

/// Pixels that light is added to.
struct SkySeen {
    const CameraParams& camera;
    Span<const float> opaque_depth;   ///< less than 1e30 m: nothing is added; empty: sky everywhere
    Span<const float> transmittance;  ///< of media before it; empty: 1
    float* behind;                    ///< [3][pixel]

    /// How much of the sky a pixel shows.
    float share(std::size_t pixel) const {
        if (opaque_depth.size > 0 && opaque_depth.data[pixel] < 1e30f) return 0;
        return transmittance.size > 0 ? transmittance.data[pixel] : 1.0f;
    }
};

/// Nothing where the air has no such light. `points`: single stars, too.
void show_night(int threads, const Atmosphere& air, const SkySeen& on, bool points = true);

}  // namespace pileus
