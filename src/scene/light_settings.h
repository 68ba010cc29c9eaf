// SPDX-License-Identifier: Apache-2.0
// A light of a scene besides sun and sky: a point, a spot, or parallel light.
// in: keys of [[light]] -> out: plain values.
// docs/lights.md.
#pragma once
#include <array>
#include <string>

#include "src/base/vectors.h"

namespace pileus {

enum class LampKind { kPoint, kSpot, kDirectional };

/// Of a scene, as of all tables of one list.
constexpr std::size_t kMaxLights = 64;

struct LightSettings {
    LampKind type = LampKind::kPoint;
    Double3 position_m{};                        ///< point, spot
    std::array<float, 3> intensity{1, 1, 1};     ///< radiant: irradiance at one metre; point, spot
    double radius_m = 0;                         ///< of a sphere; point, spot; 0: a point
    int shadow_samples = 8;                      ///< places on it; 1: shadows of a point
    Double3 direction{};                         ///< spot: where it shines; zero: towards target_m
    Double3 target_m{};                          ///< spot
    double cone_deg = 40;                        ///< spot: the whole angle of its cone; (0, 360]
    double penumbra_deg = 0;                     ///< spot: width of the soft edge inside; >= 0
    double azimuth_deg = 0, elevation_deg = 45;  ///< directional: where it stands, as the sun
    std::array<float, 3> irradiance{1, 1, 1};    ///< directional: on a plane facing it
};

inline bool operator==(const LightSettings& a, const LightSettings& b) {
    return a.type == b.type && a.position_m == b.position_m && a.intensity == b.intensity &&
           a.radius_m == b.radius_m && a.shadow_samples == b.shadow_samples &&
           a.direction == b.direction && a.target_m == b.target_m && a.cone_deg == b.cone_deg &&
           a.penumbra_deg == b.penumbra_deg && a.azimuth_deg == b.azimuth_deg &&
           a.elevation_deg == b.elevation_deg && a.irradiance == b.irradiance;
}

// Clear air around a round earth. docs/atmosphere.md

struct AtmosphereSettings {
    bool present = false;
    std::string date;            ///< "2026-06-21"; empty: [sun] says where the sun stands
    std::string time = "12:00";  ///< of the clock at utc_offset_h
    double utc_offset_h = 0;     ///< hours that clock is ahead of universal time
    double latitude_deg = 0, longitude_deg = 0;
    double turbidity = 2;        ///< of air and haze over that of air; [1, 10]
    double ground_albedo = 0.2;  ///< of the round earth where there is no [ground]
    bool refraction = true;      ///< lifts the sun of a date
    bool sun_disc = true;        ///< the sun itself is seen in the sky
    bool moon = false;           ///< that of the date is seen, and lights the night
    bool stars = false;          ///< those of the date are seen, and their light is part of the sky
    bool airglow = false;        ///< the air's own light, and zodiacal light, are part of the sky
};

}  // namespace pileus
