// SPDX-License-Identifier: Apache-2.0
// See place_scene.h.
#include "src/world/place_scene.h"

#include "src/world/atmosphere/atmosphere.h"
#include "src/world/camera/places.h"

namespace pileus {

Status place_scene(Scene& scene, WeatherFiles* files) {
    PILEUS_TRY(place_camera(scene, files));
    place_sun(scene.atmosphere, scene.hours_later, scene.sun);
    place_night(scene.atmosphere, scene.hours_later, scene.night);
    return check_camera_in_air(scene, scene.camera, scene.ground);
}

}  // namespace pileus
