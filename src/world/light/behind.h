// SPDX-License-Identifier: Apache-2.0
// What a march reads of the light behind media that turns within the peak of their phase function.
// in: media, lights -> out: BehindView.
// docs/ordinates.md, "The march"
#pragma once
#include "kernels_cpu/display/march_params.h"
#include "src/world/light/beam.h"
#include "src/world/light/lights.h"

namespace pileus {

/// What peaks of a width in degrees, of which `peak` has the media's shares, see of the horizon.
void set_horizon(const Medium& medium, const Beam& peak, double peak_deg, BehindView& out);

/// Sky and ground, whose mean radiance is `ground`.
void set_behind(const Lighting& light, const Double3& ground, BehindView& out);

}  // namespace pileus
