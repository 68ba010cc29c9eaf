// SPDX-License-Identifier: Apache-2.0
// A scene after reading: what no frame changes.
// in: TOML (docs/scene.md) -> out: this struct, read only once a picture is begun.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "src/scene/animation.h"
#include "src/scene/atmosphere_settings.h"
#include "src/scene/clouds_settings.h"
#include "src/scene/media/medium_settings.h"

namespace pileus {

struct OutputSettings {
    std::vector<std::string> files;  ///< relative to the scene's folder
    std::string report;
    bool layer_depth = false, layer_error = false, layer_cloud = false;
    bool layer_optical_depth = false, layer_transmittance = false;
    bool layer_light = false, layer_order = false;
    bool layer_reflectance = false, layer_shadow = false, layer_occlusion = false;
};

struct Description {
    std::int64_t seed = 0;
    AtmosphereSettings atmosphere;  ///< in place of the sky; colours the sun
    std::vector<SolidSettings> solids;
    std::vector<MediumSettings> media;
    CloudsSettings clouds;  ///< kinds and places of many clouds, in place of media
    std::string method = "collectors";
    OutputSettings output;
    Animation animation;

    /// Whether pictures need the distance to the media: a layer shows it, or the air before them.
    bool wants_depth() const { return output.layer_depth || atmosphere.present; }
};

}  // namespace pileus
