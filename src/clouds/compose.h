// SPDX-License-Identifier: Apache-2.0
// Pictures of clouds one over the other, the nearest first.
// in: what stands for each cloud, from near to far -> out: planes of their light alone.
// docs/clouds.md
#pragma once
#include "src/clouds/impostor.h"

namespace pileus {

/// What stands for a cloud: an impostor, or a picture of this frame; neither: nothing.
struct CloudSource {
    const Impostor* impostor = nullptr;
    const MarchedCloud* picture = nullptr;
};

/// A cloud of the picture; where `share` < 1 the older source has the rest.
struct CloudLayer {
    CloudSource newer, older;
    float share = 1;
    PixelRect rect;
};

/// Colour, transmittance and, in `half_depth`, depths of nothing. `planes` are allocated.
void begin_clouds(int threads, Planes& planes);

/// Adds a cloud behind those that are there. Opaque depths of `planes`, where there are any, hide
/// what lies behind them; depths are sums, weighted by what each cloud hides.
void add_cloud(const CloudView& view, const CloudLayer& layer, int threads, Planes& planes);

/// Sums of depths become means.
void end_clouds(int threads, Planes& planes);

}  // namespace pileus
