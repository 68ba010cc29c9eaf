// SPDX-License-Identifier: Apache-2.0
// Lit collectors as planes of pixels: all of the light, or a part of it.
// in: CollectorsState after shooting, colours -> out: Planes.
// docs/methods.md 3, each image frame, steps 4 and 5; docs/formats.md, "Pictures out".
#pragma once
#include "src/methods/collectors/collectors_state.h"
#include "src/picture/layers.h"

namespace pileus {

/// Transmittance, colour and half depth of the media, lit by `colours` and, where the march does
/// the first order, by the sun and the constant of `lit.lighting`. Without colours (the march
/// alone): these two.
Status collectors_display(const Context& context, const FrameView& view, CollectorsState& state,
                          const ReconstructInput& lit, const CollectorColours& colours,
                          int channels, Planes& planes);

/// Fills the planes that the layers optical_depth, light and order show, as far as they are asked
/// for. `lit` is the whole light's.
Status collectors_parts(const Context& context, const FrameView& view, CollectorsState& state,
                        const ReconstructInput& lit, Planes& planes);

}  // namespace pileus
