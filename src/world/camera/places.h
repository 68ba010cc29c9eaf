// SPDX-License-Identifier: Apache-2.0
// A camera at longitudes and latitudes, and the place of its picture on the map.
// in: a scene with weather data -> out: a camera in metres; extent and projection of a picture.
// docs/weather.md, "Places", "Pictures on the map"
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "src/base/status.h"
#include "src/scene/scene.h"

namespace pileus {

class WeatherFiles;

/// Fills in position_m and target_m of a camera that is told by places, which then is as one told
/// in metres. kBadInput: no weather data, no map, a place beyond it, or a camera that looks nowhere
/// or stands below the ground.
/// `files`: through which the file is read; null: it is opened for that alone.
Status place_camera(Scene& scene, WeatherFiles* files = nullptr);

/// What a picture of a camera of the scene says of its place where that is orthographic and looks
/// straight down on weather data: names and texts "extent_m" ("west south east north", where up is
/// north), "world_file" (six numbers of a world file, parted by blanks) and "projection" as PROJ
/// writes it, left out where the file tells of no map. Empty for all other cameras.
std::vector<std::pair<std::string, std::string>> picture_place(const Scene& scene,
                                                               const Camera& camera,
                                                               double orbit_deg,
                                                               WeatherFiles* files = nullptr);

}  // namespace pileus
