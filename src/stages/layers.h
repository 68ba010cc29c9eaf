// SPDX-License-Identifier: Apache-2.0
// From composited planes to the layers of an image file.
// in: media's light, transmittance, depths, background -> out: R G B A, cloud.*, Z, error.*.
// docs/formats.md, "Pictures out".
#pragma once
#include "src/base/buffer.h"
#include "src/base/report.h"
#include "src/io/image.h"
#include "src/scene/scene.h"

namespace pileus {

/// Planes of one picture, rows from the top. `colour` is [3 * (1 + batches)][pixel].
struct Planes {
    Buffer<float> transmittance, colour;
    Buffer<float> half_depth;    ///< empty where no layer shows it
    Buffer<float> background;    ///< [3][pixel]
    Buffer<float> opaque_depth;  ///< [pixel]; infinity for the sky; empty: nothing solid
};

/// `solid`: something opaque may end rays; `depth`: the layer of depths is wanted.
Status allocate_planes(int width, int height, int channels, bool solid, bool depth, Planes& planes);

/// Fills the image's channels and the report's error figures; counts pixels that are not finite.
/// Radiances below zero, noise of the light that the cloud keeps from the ground, become 0 and are
/// added to `clamped`.
Status make_layers(const Planes& planes, int width, int height, int channels,
                   const OutputSettings& output, Image& image, Report& report,
                   std::uint64_t& clamped);

}  // namespace pileus
