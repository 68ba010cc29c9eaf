// SPDX-License-Identifier: Apache-2.0
// From composited planes to the layers of an image file.
// in: light, its parts, transmittance, depths, background -> out: R G B A and the layers asked for.
// docs/formats.md, "Pictures out".
#pragma once
#include "src/base/buffer.h"
#include "src/io/images/image.h"
#include "src/picture/errors/pixel_errors.h"
#include "src/plan/array.h"
#include "src/plan/report.h"
#include "src/scene/scene.h"
#include "src/world/light/lights.h"

namespace pileus {

struct LateRows;

/// Planes of one picture, rows from the top. `colour` is [3 * (1 + batches)][pixel]. Those from
/// `optical_depth` on are empty where no layer shows them or a method has no such thing.
struct Planes {
    Buffer<float> transmittance, colour;
    Buffer<float> half_depth;     ///< empty where no layer shows it
    Buffer<float> background;     ///< [3][pixel]; empty: `colour` is the light of whole rays
    Buffer<float> opaque_depth;   ///< [pixel]; infinity for the sky; empty: nothing solid
    Buffer<float> optical_depth;  ///< [pixel]
    Buffer<float> through;        ///< [pixel], what whole rays leave, as the layer of transmittance
                                  ///< shows it; empty: `transmittance`, to where colours end
    bool whole_alpha = false;     ///< alpha shows that, too
    Buffer<float> cloud;          ///< [3][pixel], the media's light; empty: `colour` is that
    Buffer<float> sun;            ///< [3][pixel], of R G B what began at the sun
    Buffer<float> single;         ///< [3][pixel], of the media's light what was scattered once
    Buffer<float> lamps;          ///< [lamp][3][pixel], of R G B what each of [[light]] sends
    Buffer<float> emission;       ///< [3][pixel], of R G B what the media emit
    Buffer<float> error;          ///< [3][pixel], one standard error; empty: from the batches
    Buffer<float> occlusion;      ///< [pixel], share of the sky that the media hide
    Buffer<float> kept;         ///< [3][pixel], share of a host's own pixel that the air before it
                                ///< leaves, 0: nothing of it is seen; empty: not wanted
    int batches = 0;            ///< parts of the light behind the picture's own colours
    std::uint64_t clamped = 0;  ///< numbers below 0 that became 0 on the way here
    /// Takes what may wait until pixels are written, as a caller allows it; null: nothing may.
    LateRows* late = nullptr;

    int channels() const { return 3 * (1 + batches); }
};

/// How the planes' pixels speak for one another.
PixelGroups groups_of(const Planes& planes, int width, int height);

/// By the planes' batches.
ErrorSum batch_error_sum(const Planes& planes, int width, int height);

/// Numbers per pixel that allocate_planes makes room for.
inline std::uint64_t plane_count(std::uint64_t channels, bool solid, bool depth) {
    return 1 + channels + (channels > 0 ? 3u : 0u) + (solid ? 1u : 0u) + (depth ? 1u : 0u);
}

namespace arrays {

/// So many numbers for each pixel, from the stage that begins the picture on.
inline Array<float> picture_planes(std::uint64_t numbers, std::uint64_t pixels,
                                   Stage first = Stage::kBackground) {
    return {"picture planes", bytes_of(numbers, pixels), first, Stage::kLayers};
}

}  // namespace arrays

/// `solid`: something opaque may end rays; `depth`: the layer of depths is wanted. Without channels
/// of colour there is no background either. Batches follow from the channels; nothing is clamped.
Status allocate_planes(int width, int height, int channels, bool solid, bool depth, Planes& planes);

/// Room for what some pictures of a run have and others have not: depths of the media and, where
/// `solid`, of what is opaque. kLimit: out of memory.
Status reserve_depths(const std::array<int, 2>& resolution, bool solid, Planes& planes);

/// Layers of the image that are asked for, beside the four that are always there.
std::uint64_t extra_layers(const OutputSettings& output, bool has_depth, bool has_error);

/// reflectance.R/G/B: pi R/(mu0 E) of an image that begins with R G B; 0 without a sun above the
/// horizon. kLimit: out of memory.
Status add_reflectance(const Lighting& lighting, Image& image);

/// Fills the image's channels and the report's error figures; counts pixels that are not finite,
/// and what was clamped: radiances below zero, noise of the light that the cloud keeps from the
/// ground, become 0, too. sky.* is R G B less sun.* and other parts that there are, multiple.* the
/// media's light less single.*.
Status make_layers(const Planes& planes, int width, int height, const OutputSettings& output,
                   Image& image, Report& report, std::uint64_t& clamped);

}  // namespace pileus
