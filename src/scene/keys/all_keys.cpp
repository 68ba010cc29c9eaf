// SPDX-License-Identifier: Apache-2.0
// See all_keys.h.
// in: the rows of each table -> out: all rows; every value of a scene.
// docs/scene.md.
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

/// "medium.N.albedo" with the index in place of N.
std::string path_at(const char* path, std::size_t index) {
    std::string text = path;
    return text.replace(text.find(".N.") + 1, 1, std::to_string(index));
}

bool begins_with(const char* path, std::string_view start) {
    return std::string_view(path).substr(0, start.size()) == start;
}

}  // namespace

std::vector<const KeyRow*> all_scene_keys() {
    std::vector<const KeyRow*> rows;
    const auto add = [&](const Span<const KeyRow>& table) {
        for (const KeyRow& row : table) rows.push_back(&row);
    };
    add(view_keys());
    add(atmosphere_keys());
    add(light_keys());
    add(solid_keys());
    add(medium_keys());
    rows.push_back(&transfer_key());
    for (const KeyRow* row : phase_keys()) rows.push_back(row);
    add(medium_last_keys());
    add(detail_keys());
    add(weather_keys());
    add(particle_keys());
    add(sky_keys());
    add(cloud_keys());
    add(recipe_keys());
    add(clouds_keys());
    add(method_keys());
    for (const MethodKeys& method : all_methods()) add(method.rows());
    add(filter_keys());
    add(later_keys());
    add(output_keys());
    return rows;
}

void for_each_key(const Scene& scene, const KeyVisit& visit) {
    const MediumSettings no_medium;
    const SolidSettings no_solid;
    const LightSettings no_light;
    for (const KeyRow* row : all_scene_keys()) {
        if (row->field.get == nullptr) continue;
        if (begins_with(row->path, "medium.N."))
            for (std::size_t i = 0; i < scene.media.size(); ++i)
                visit(*row, path_at(row->path, i), {scene, scene.media[i], no_solid, no_light});
        else if (begins_with(row->path, "solid.N."))
            for (std::size_t i = 0; i < scene.solids.size(); ++i)
                visit(*row, path_at(row->path, i), {scene, no_medium, scene.solids[i], no_light});
        else if (begins_with(row->path, "light.N."))
            for (std::size_t i = 0; i < scene.lights.size(); ++i)
                visit(*row, path_at(row->path, i), {scene, no_medium, no_solid, scene.lights[i]});
        else
            visit(*row, row->path, {scene, no_medium, no_solid, no_light});
    }
}

}  // namespace pileus
