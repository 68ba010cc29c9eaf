// SPDX-License-Identifier: Apache-2.0
// What a scene's text leaves to files and dates: where camera and sun are.
// in: a scene as it was read -> out: its frame at rest, in metres and degrees.
// docs/weather.md, "Places"; docs/atmosphere.md
#pragma once
#include "src/base/status.h"
#include "src/scene/scene.h"

namespace pileus {

class WeatherFiles;

/// Camera by the map of weather data in one of `files`, sun by the date, both once. kBadInput: as
/// place_camera; a camera above the air.
Status place_scene(Scene& scene, WeatherFiles* files);

}  // namespace pileus
