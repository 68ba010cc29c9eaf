// SPDX-License-Identifier: Apache-2.0
// Laws between the keys of the ground's surface: a map of its albedo, a sea.
// in: keys that passed their own checks -> out: paths and defaults of the Scene; faults.
// docs/ground.md
#include "src/scene/checks/check_keys.h"
#include "src/scene/method_column.h"

namespace pileus {
namespace {

void check_ground_map(SceneCheck& check) {
    GroundSurface& surface = check.scene.surface;
    if (check.key("ground.map") == nullptr) {
        for (const char* key : {"ground.map_low_m", "ground.map_size_m", "ground.map_repeats"})
            conflict(check, key, "a ground without a map");
        return;
    }
    const Node* map = check.valid_key("ground.map");
    if (map == nullptr) return;
    check_picture(check, *map, "ground.map", is_read, surface.map);
    if (surface.sea) conflict(check, "ground.map", "surface \"sea\"");
    if (!(surface.map_size_m[0] > 0 && surface.map_size_m[1] > 0))
        check.faults.add(map->at, "ground.map",
                         "without ground.map_size_m, " + value_text(*map) +
                             ", allowed: with its size in metres, east and north");
}

/// What water sends back, where a file leaves it out: clear sea in the visible.
void fill_water(SceneCheck& check) {
    if (check.key("ground.albedo") == nullptr) check.scene.ground.albedo = 0.022;
    if (check.key("ground.colour") == nullptr) check.scene.surface.colour = {0.2f, 0.8f, 2.0f};
}

}  // namespace

void check_surface(SceneCheck& check) {
    GroundSurface& surface = check.scene.surface;
    if (const Support* no = refused(check.scene, Feature::kSea))
        if (const Node* kind = check.key("ground.surface"); surface.sea && kind != nullptr)
            add_refusal(check, *kind, "ground.surface", *no, "\"sea\"");
    for (const char* key : {"ground.sea_wind_m_s", "ground.sea_wind_from_deg"})
        if (!surface.sea) conflict(check, key, "surface \"land\"");
    if (surface.sea && check.written) fill_water(check);
    check_ground_map(check);
    const char* const keys[] = {"ground.colour", "ground.albedo"};
    for (const char* key : keys) {
        const Node* node = check.valid_key(key);
        if (node == nullptr || !sends_too_much(surface, check.scene.ground.albedo)) continue;
        check.faults.add(node->at, key,
                         "more than all light is sent back, " + value_text(*node) +
                             ", allowed: ground.colour at most 1 when times ground.albedo");
        break;
    }
}

}  // namespace pileus
