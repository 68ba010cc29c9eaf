// SPDX-License-Identifier: Apache-2.0
// What a frame of an animation has of its own.
// in: a scene, the number of a frame -> out: camera, sun, time, place of the media.
// docs/animation.md
#pragma once
#include "src/scene/scene.h"

namespace pileus {

/// The sun of a frame, in the media's coordinates; `rest`: as it is but for the animation.
SunPlace sun_at(const Scene& scene, const Sun& rest, int frame);
/// Angle by which the camera has turned about its target in a frame, degrees.
double orbit_at(const Scene& scene, int frame);
/// The camera before that, but for the media's place.
Camera camera_at(const Animation& animation, const Camera& rest, int frame);
/// Hours after atmosphere.time; seconds that the wind has blown beside those of each sky.
double hours_at(const Scene& scene, int frame);
double wind_at(const Scene& scene, int frame);
/// Which world it has. Equal keys: the same files and the same wind.
WorldKey world_key_at(const Scene& scene, int frame);

Placement placement_at(const Scene& scene, int frame);

/// `out`: a frame of the scene's animation in the scene's coordinates; `rest`: but for keys. Only
/// what keys move differs; ranges are asked for by `sun_at` and `orbit_at`.
void frame_state_at(const Scene& scene, const FrameState& rest, int frame, FrameState& out);
/// Moves a scene, in the media's coordinates, to a frame.
void place_at_frame(const FrameState& rest, int frame, Scene& scene);

/// Whether frames differ in these, by ranges or keys.
bool moves_sun(const Scene& scene);
bool moves_time(const Scene& scene);
bool moves_wind(const Scene& scene);
bool moves_media(const Scene& scene);
/// The key that makes frames see the media from different places; null: none does.
const char* mover_of_view(const Scene& scene);
/// The most of the sun's elevations; `rest` as for sun_at.
double highest_sun(const Scene& scene, const Sun& rest);

}  // namespace pileus
