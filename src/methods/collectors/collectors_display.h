// SPDX-License-Identifier: Apache-2.0
// Lit collectors as planes of pixels: all of the light, or a part of it.
// in: CollectorsRun after shooting, colours -> out: Planes.
// docs/methods.md 3, each image frame, steps 4 and 5; docs/formats.md, "Pictures out".
#pragma once
#include "src/methods/collectors/collectors.h"
#include "src/picture/layers.h"

namespace pileus {

namespace arrays {

/// Optical depths towards the sun, from the first stage that shows or, in animations, shoots.
inline Array<float> shadow(std::uint64_t nodes, Stage first) {
    return {"shadow", nodes, first, Stage::kWrite};
}
/// With the ground's light of the batch beside it.
inline Array<float> batch_background(std::uint64_t pixels) {
    return {"ground light of a batch", bytes_of(3, pixels), Stage::kLayers, Stage::kLayers};
}

}  // namespace arrays

/// Batches of generations that this run's error is made from; 0: none.
int collectors_batches(const CollectorsRun& run);

/// What lies behind the media in `lit.lighting`: its planes' background and opaque depth.
Status collectors_background(const Context& context, const CollectorsRun& run,
                             const ReconstructInput& lit, Planes& planes);

/// Adds to every batch's colour what its own photons brought to the ground, seen through the media:
/// the spread of the batches then holds that light's noise, too. After collectors_display.
Status collectors_ground_noise(const Context& context, const CollectorsRun& run,
                               const ReconstructInput& lit, Planes& planes);

/// Transmittance, colour and half depth of the media, lit by `colours` and, where the march does
/// the first order, by the sun and the constant of `lit.lighting`. Without colours (the march
/// alone): these two.
Status collectors_display(const Context& context, CollectorsRun& run, const ReconstructInput& lit,
                          const CollectorColours& colours, int channels, Planes& planes);

/// Fills the planes that the layers optical_depth, light and order show, as far as they are asked
/// for. `lit` is the whole light's.
Status collectors_parts(const Context& context, CollectorsRun& run, const ReconstructInput& lit,
                        Planes& planes);

}  // namespace pileus
