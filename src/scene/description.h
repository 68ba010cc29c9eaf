// SPDX-License-Identifier: Apache-2.0
// A scene after reading: what no frame changes.
// in: TOML (docs/scene.md) -> out: this struct, read only once a picture is begun.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/scene/animation.h"
#include "src/scene/clouds_settings.h"
#include "src/scene/file_layers.h"
#include "src/scene/light_settings.h"
#include "src/scene/media/medium_settings.h"

namespace pileus {

/// Files and places that belong to the view.
struct ViewFiles {
    std::string sky_map;         ///< image of the sky, relative to the scene file; empty: none
    std::string depth;           ///< image of the way to solid things; empty: none
    bool depth_on_axis = false;  ///< depth_kind = "z": along the view's axis, not along each ray
    double depth_scale = 1;      ///< metres per unit of its values; > 0
    bool position_by_place = false, target_by_place = false;  ///< by the weather file's map
    Double3 position_place{}, target_place{};  ///< longitude, latitude in degrees, height in m
};

/// Longitude and latitude of a place, in degrees.
inline bool is_on_map(const Double3& place) {
    return place[0] >= -360 && place[0] <= 360 && place[1] >= -90 && place[1] <= 90;
}
constexpr const char* kPlacesOnMap = "longitude -360 to 360, latitude -90 to 90";

/// What the level ground looks like beside its mean albedo.
struct GroundSurface {
    bool sea = false;
    double wind_m_s = 6;                ///< over the sea
    double wind_from_deg = 240;         ///< from north towards east
    Float3 colour{1, 1, 1};             ///< albedo by channel over Ground::albedo
    std::string map;                    ///< image of its albedo; empty: none
    std::array<double, 2> map_low_m{};  ///< south-west corner of the map, x and y
    std::array<double, 2> map_size_m{};
    bool map_repeats = false;
};

/// Whether there is no more to it than the ground's albedo.
inline bool is_grey_land(const GroundSurface& surface) {
    return !surface.sea && surface.map.empty() && surface.colour == Float3{1, 1, 1};
}
/// Whether a channel of it sends back more light than falls on it, where the mean is `albedo`.
inline bool sends_too_much(const GroundSurface& surface, double albedo) {
    for (const float channel : surface.colour)
        if (double(channel) * albedo > 1 + 1e-6) return true;
    return false;
}

struct Lens {
    double aperture_radius_m = 0;  ///< 0: a pinhole
    double focus_distance_m = 0;   ///< along the view; 0: the target's
    double shutter_s = 0;          ///< how long it is open, the frame's time in the middle
};

struct OutputSettings : FileLayers {
    std::vector<std::string> files;  ///< relative to the scene's folder
    std::string report;
    bool layer_depth = false, layer_cloud = false;
};

struct Description {
    std::int64_t seed = 0;
    AtmosphereSettings atmosphere;  ///< in place of the sky; colours the sun
    std::vector<SolidSettings> solids;
    std::vector<MediumSettings> media;
    CloudsSettings clouds;  ///< kinds and places of many clouds, in place of media
    std::string method = "collectors";
    ViewFiles view_files;
    GroundSurface surface;
    Lens lens;
    std::array<int, 4> crop{};  ///< x0, y0, x1, y1: pixels of the picture that are shown, ends
                                ///< exclusive; all 0: the whole picture
    OutputSettings output;
    Animation animation;
};

}  // namespace pileus
