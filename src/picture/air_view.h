// SPDX-License-Identifier: Apache-2.0
// A finished picture seen through the air: what it takes and adds before media, ground and solids,
// and the sky behind them.
// in: planes with transmittance and depths, the atmosphere -> out: the same planes, changed.
// docs/atmosphere.md, "In front of things"
#pragma once
#include "src/picture/layers.h"
#include "src/run/context.h"
#include "src/world/environment.h"

namespace pileus {

/// Nothing without an atmosphere. `planes` hold the media's light in `colour` (all parts of its
/// noise, too) and what is behind them in `background`. kLimit: out of memory.
Status show_air(const Context& context, const Scene& scene, const Medium& medium,
                const Lighting& lighting, const CameraParams& camera, Environment& environment,
                Planes& planes);

/// The same where `behind` is [3][pixel], light that has come through the media, and `light`
/// theirs.
struct AirPlanes {
    float *light, *behind;
    float* dimmed = nullptr;  ///< [3][pixel]; null: not wanted
    bool through = false;
    float* kept = nullptr;  ///< [3][pixel], transmittance to what stands behind; null: not wanted
    bool bodies = true;     ///< sun, moon and single stars are seen
};
Status run_air(const Context& context, const Scene& scene, const Medium& medium,
               const Lighting& lighting, const CameraParams& camera, Environment& environment,
               const Planes& planes, const AirPlanes& on);

}  // namespace pileus
