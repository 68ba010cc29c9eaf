// SPDX-License-Identifier: Apache-2.0
// See places.h.
#include "src/world/camera/places.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "src/base/number_text.h"
#include "src/io/volumes/weather_file.h"
#include "src/scene/frame_fault.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/volume_format.h"
#include "src/scene/toml/toml_tree.h"
#include "src/world/camera/view.h"

namespace pileus {
namespace {

/// The first medium that is weather data; null: there is none.
const MediumSettings* weather_of(const Scene& scene) {
    for (const MediumSettings& medium : scene.media)
        if (is_weather_format(medium.source.format)) return &medium;
    return nullptr;
}

Status map_of(const Scene& scene, WeatherFiles* files, WeatherMap& map) {
    const MediumSettings* medium = weather_of(scene);
    if (medium == nullptr)
        return Status::bad_input(
            "no map to find it on, allowed: with a medium of weather data, or in metres");
    return read_weather_map(*medium, density_path(scene, *medium), map, files);
}

Status check_view(const Scene& scene) {
    switch (frame_fault(scene.ground, scene.camera)) {
        case FrameFault::kAtTarget:
            return Status::bad_input("same as the target, allowed: any other place");
        case FrameFault::kAlongUp:
            return Status::bad_input(
                "the view is along camera.up, allowed: any direction across it");
        case FrameFault::kUnderground:
            return Status::bad_input(
                "below the ground, z " + number_text(scene.camera.position_m[2]) +
                ", allowed: at least ground.altitude_m " + number_text(scene.ground.altitude_m));
        default:
            break;
    }
    return Status::ok();
}

}  // namespace

Status place_camera(Scene& scene, WeatherFiles* files) {
    Camera& c = scene.camera;
    ViewFiles& by = scene.view_files;
    if (!by.position_by_place && !by.target_by_place) return Status::ok();
    const char* key = by.position_by_place ? "camera.position_deg" : "camera.target_deg";
    WeatherMap map;
    PILEUS_TRY(at_key(scene, key, map_of(scene, files, map)));
    if (by.position_by_place)
        PILEUS_TRY(at_key(scene, key, map.place("place", by.position_place, c.position_m)));
    if (by.target_by_place)
        PILEUS_TRY(
            at_key(scene, "camera.target_deg", map.place("place", by.target_place, c.target_m)));
    by.position_by_place = by.target_by_place = false;
    return at_key(scene, key, check_view(scene));
}

std::vector<std::pair<std::string, std::string>> picture_place(const Scene& scene, const Camera& c,
                                                               double orbit_deg,
                                                               WeatherFiles* files) {
    std::vector<std::pair<std::string, std::string>> told;
    if (!c.orthographic || c.flux || c.has_frustum || weather_of(scene) == nullptr) return told;
    const Double3 position = orbit(c.position_m, c.target_m, orbit_deg);
    const Double3 view = glm::normalize(c.target_m - position);
    if (!(view[2] < -1 + 1e-12)) return told;
    // Right and up of the picture on the map, pixels and the middle of the first one.
    const Double3 up = glm::normalize(Double3{c.up[0], c.up[1], 0});
    const Double3 right{up[1], -up[0], 0};
    const int columns = c.resolution[0] + c.window.more[0],
              rows = c.resolution[1] + c.window.more[1];
    const std::array<int, 4> whole{0, 0, columns, rows};
    const std::array<int, 4>& shown = scene.crop[2] > 0 ? scene.crop : whole;
    const double size = c.height_m / rows;
    // Edges of what is shown, from the picture's middle to the right and up.
    const double west = size * (shown[0] - 0.5 * columns), east = size * (shown[2] - 0.5 * columns);
    const double south = size * (0.5 * rows - shown[3]), north = size * (0.5 * rows - shown[1]);
    const Double3 first = position + (west + 0.5 * size) * right + (north - 0.5 * size) * up;
    told.emplace_back(
        "world_file",
        // Adding 0 makes -0 plain.
        fmt::format("{} {} {} {} {} {}", size * right[0] + 0.0, size * right[1] + 0.0,
                    -size * up[0] + 0.0, -size * up[1] + 0.0, first[0] + 0.0, first[1] + 0.0));
    if (up[1] == 1)
        told.emplace_back("extent_m",
                          fmt::format("{} {} {} {}", position[0] + west, position[1] + south,
                                      position[0] + east, position[1] + north));
    WeatherMap map;
    if (map_of(scene, files, map)) told.emplace_back("projection", map.projection());
    return told;
}

}  // namespace pileus
