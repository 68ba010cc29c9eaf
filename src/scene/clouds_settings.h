// SPDX-License-Identifier: Apache-2.0
// A sky of many clouds as a scene says it: kinds from scenes of their own, and where they stand.
// in: keys of [clouds] -> out: plain values; src/clouds makes clouds of them.
// docs/clouds.md
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/base/vectors.h"

namespace pileus {

constexpr std::size_t kMaxCloudKinds = 64, kMaxScatters = 64, kMaxClouds = 1000;
constexpr std::size_t kMaxCloudLayers = 8;

struct CloudKindSettings {
    std::string name;
    std::string scene;              ///< its file, relative to the scene file
    std::vector<std::string> sets;  ///< "key=value", put into it
    std::string text;               ///< not empty: the scene itself, in place of a file
};

/// A sheet of clouds over all of the sky: a scene with media that have a place of their own.
struct CloudLayerSettings {
    std::string scene;              ///< its file, relative to the scene file
    std::vector<std::string> sets;  ///< "key=value", put into it
    std::string text;               ///< not empty: the scene itself, in place of a file
};

/// A report of the weather, of which clouds, haze and rain are made. docs/metar.md
struct ReportSettings {
    std::string metar;         ///< METAR or SPECI; empty: none
    std::int64_t seed = 0;     ///< another one, other clouds of the same report
    double elevation_m = 0;    ///< of the station: heights of a report count from it
    bool report_time = false;  ///< the sun by the time of the report: there is a date, and no time

    bool present() const { return !metar.empty(); }
};

struct CloudPlaceSettings {
    std::string kind;
    Double3 offset_m{};
    double yaw_deg = 0;
    double scale = 1;
};

/// Many places by random numbers, none over another.
struct CloudScatter {
    std::vector<std::string> kinds;  ///< of each as many, by chance; none: all
    int count = 1;
    std::int64_t seed = 0;
    double near_m = 1000, far_m = 100000;   ///< from the centre; as many in each ring of one ratio
    bool has_center = false;                ///< false: below the camera's place of the file
    std::array<double, 2> center_m{};       ///< x and y
    std::array<double, 2> base_m{};         ///< least and most height of a box's low side
    std::array<double, 2> scale{1.0, 1.0};  ///< least and most
    int yaw_steps = 4;                      ///< turns by so many equal steps
    bool fewer = false;                     ///< where there is no room for all: as many as fit
};

/// What may be less exact, and what it may cost.
struct CloudDetail {
    bool on = true;         ///< false: every cloud is marched in every frame
    double error_px = 0.5;  ///< that a far cloud's picture may be wrong by
    double near_px = 256;   ///< clouds of that size on the picture are marched
    int near_scale = 2;     ///< of those, one pixel of so many along x and y: 1, 2, 4
    int blend_frames = 8;   ///< over which one impostor cross-fades to the next
    double sharpness = 1;   ///< texels of a pixel along x and y
    /// Of pictures that a frame makes anew: one, and more up to so many in all.
    std::int64_t frame_pixels = 60000;
    double sun_deg = 0.5;  ///< that the sun may move until a kind is lit anew
};

struct CloudsSettings {
    std::vector<CloudKindSettings> kinds;
    std::vector<CloudPlaceSettings> places;
    std::vector<CloudScatter> scatters;
    std::vector<CloudLayerSettings> layers;
    ReportSettings weather;
    CloudDetail detail;

    /// Whether the scene is a sky with clouds.
    bool present() const { return !kinds.empty() || !layers.empty() || weather.present(); }
};

}  // namespace pileus
