// SPDX-License-Identifier: Apache-2.0
// Pictures of clouds and layers one over the other, in each pixel the nearest first.
// in: what stands for each, by the least distance -> out: planes of their light alone.
// docs/clouds.md
#pragma once
#include "src/clouds/impostor.h"
#include "src/clouds/layer.h"

namespace pileus {

/// A layer's picture of this frame. Fully in its own session.
struct LayerPicture {
    const Planes* planes = nullptr;
    const SkyLayer* layer = nullptr;
    /// What of the sun comes to it past the others, and the share of its light that is the sun's.
    const SunPlane* plane = nullptr;
    const std::vector<ShadowSource>* sources = nullptr;  ///< without itself; null: nothing
    std::array<float, 3> sun_share{};
    float sky_left = 1;  ///< of the rest, through layers above
};

/// What stands for a cloud: an impostor, or a picture of this frame; neither: nothing.
struct CloudSource {
    const Impostor* impostor = nullptr;
    const MarchedCloud* picture = nullptr;
    std::array<float, 3> gain{1, 1, 1};  ///< on its light, of a sun that has moved since
};

/// A cloud or a layer of the picture; where `share` < 1 the older source has the rest.
struct ShownCloud {
    CloudSource newer, older;
    float share = 1;
    float presence = 1;                   ///< factor on its alpha, with its light
    const LayerPicture* layer = nullptr;  ///< in place of both sources
    PixelRect rect;
    float near_m = 0;  ///< nothing of it is nearer
};

/// Lays them over one another where opaque depths of `planes`, if there are any, do not hide them:
/// colours, transmittance, and in `half_depth` depths weighted by what each hides. `shown`: by
/// near_m. In a pixel up to kCloudsInPixel are sorted at a time; a nearest one of more is final.
constexpr int kCloudsInPixel = 8;
void compose_clouds(const CloudView& view, const std::vector<ShownCloud>& shown, int threads,
                    Planes& planes);

}  // namespace pileus
