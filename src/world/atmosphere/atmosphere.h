// SPDX-License-Identifier: Apache-2.0
// The clear air of a scene: its tables, its sun, and its sky as light.
// in: a checked scene, the height of its media -> out: Atmosphere, a map of the sky.
// docs/atmosphere.md
#pragma once
#include "src/base/vectors.h"
#include "src/io/images/image.h"
#include "src/scene/scene.h"
#include "src/world/atmosphere/air_sky.h"
#include "src/world/atmosphere/stars.h"

namespace pileus {

/// Light that the air sends towards a camera, by direction and distance; what is level stays level
/// here, as the ground and the media are. air_rows.h says where slices lie; the reach is kAirReachM
/// or twenty heights of the camera.
constexpr int kAirRows = 49, kAirColumns = 17, kAirSlices = 33;
constexpr double kAirReachM = 300000;

/// Rows of the sun's depth by height, and metres from one to the next. Between rows depths are
/// linear: 2e-4 of the depth by haze.
constexpr int kSunRows = 1024;
constexpr double kSunRowM = 50;

/// A light far off, and the sky and the air that it lights.
struct FarLight {
    Double3 above{};  ///< its irradiance above the air
    double azimuth_deg = 0, elevation_deg = 0;
    AirSky sky;  ///< as the camera of the last picture saw it
    /// [slice][row][column][8], from that camera on: light over the share that air takes.
    Buffer<float> near;
};

/// The first light is the one whose beams light the scene: the sun, or the moon where the media get
/// more from it (light_atmosphere decides).
struct Atmosphere : FarLight {
    AirTables tables;
    std::array<double, 3> sunlight;  ///< share of `above` that reaches the media
    double height_km = 0;            ///< of the media's middle
    Buffer<float> sun_depth;         ///< [channel][kSunRows] towards it, from the ground up
    double camera_km = -1, reach_m = kAirReachM;

    FarLight other;          ///< the sun or the moon, whichever is not the first
    bool has_moon = false;   ///< one of both is it
    bool moonlit = false;    ///< the first is it
    bool two_skies = false;  ///< the other's sky is more than a thousandth
    double moon_radius_deg = 0;
    Double3 glow{};  ///< radiance of airglow straight up
    Stars stars;     ///< none without their key

    bool present() const { return tables.present(); }
    const FarLight& sun() const { return moonlit ? other : *this; }
    const FarLight& moon() const { return moonlit ? *this : other; }
};

/// Takes up turbidity, ground, sun and moon; what has not changed is kept. `map`: the sky
/// from the media's height, zenith first, the north in its middle, in the sun's unit.
Status light_atmosphere(const AtmosphereSettings& settings, const Sun& sun, const Ground& ground,
                        double height_m, int threads, Atmosphere& air, Image& map,
                        const Night& night = {});

/// The sky and the air as seen from a height above the ground.
Status look_from(double height_m, int threads, Atmosphere& air);

/// kBadInput: a camera above the air over a level ground, which no air would hide.
Status check_camera_in_air(const Scene& scene, const Camera& camera, const Ground& ground);

/// Where a scene with a date has its sun, so many hours later; nothing without one. `sun`: as the
/// text has it, whose irradiance is that at the mean distance.
void place_sun(const AtmosphereSettings& settings, double hours_later, Sun& sun);
/// The moon and the stars of that date, where the settings ask for them.
void place_night(const AtmosphereSettings& settings, double hours_later, Night& night);

}  // namespace pileus
