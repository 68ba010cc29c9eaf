// SPDX-License-Identifier: Apache-2.0
// What a frame of an animation has of its own.
// in: a scene, the number of a frame -> out: camera, sun, time, place of the media.
// docs/animation.md
#pragma once
#include "src/scene/scene.h"

namespace pileus {

/// The sun of a frame, in the media's coordinates.
SunPlace sun_at(const Scene& scene, int frame);
/// Angle by which the camera has turned about its target in a frame, degrees.
double orbit_at(const Scene& scene, int frame);
/// The camera before that, but for the media's place.
Camera camera_at(const Animation& animation, const Camera& rest, int frame);
/// Hours after atmosphere.time; seconds that the wind has blown beside those of each sky.
double hours_at(const Scene& scene, int frame);
double wind_at(const Scene& scene, int frame);

/// How far all media have moved, and turned about the z axis through the origin before that, from
/// north to west.
struct Placement {
    Double3 offset_m{};
    double yaw_deg = 0;
};
Placement placement_at(const Scene& scene, int frame);

/// Whether frames differ in these, by ranges or keys.
bool moves_sun(const Scene& scene);
bool moves_time(const Scene& scene);
bool moves_wind(const Scene& scene);
bool moves_media(const Scene& scene);
/// The key that makes frames see the media from different places; null: none does.
const char* mover_of_view(const Scene& scene);
/// The most of the sun's elevations.
double highest_sun(const Scene& scene);

}  // namespace pileus
