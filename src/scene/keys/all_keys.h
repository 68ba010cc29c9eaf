// SPDX-License-Identifier: Apache-2.0
// All keys that a scene may hold, table by table, and what is made from them.
// in: the rows of the files beside this one -> out: lists.
// docs/scene.md is made from these rows.
#pragma once
#include <functional>

#include "src/base/span.h"
#include "src/scene/keys/key_row.h"

namespace pileus {

Span<const KeyRow> view_keys();           // seed, camera, sun, sky, ground
Span<const KeyRow> atmosphere_keys();     // atmosphere
Span<const KeyRow> light_keys();          // light
Span<const KeyRow> solid_keys();          // solid
Span<const KeyRow> medium_keys();         // medium, up to its phase function
Span<const KeyRow> weather_keys();        // medium.density, of weather data
Span<const KeyRow> particle_keys();       // medium.density, of particles
const KeyRow& transfer_key();             // medium.transfer
Span<const KeyRow> medium_last_keys();    // medium, behind it
Span<const KeyRow> detail_keys();         // medium.detail
Span<const KeyRow> sky_keys();            // medium.sky
Span<const KeyRow> cloud_keys();          // medium.cloud
Span<const KeyRow> recipe_keys();         // medium.plume, medium.particle_cumulus
Span<const KeyRow> clouds_keys();         // clouds
Span<const KeyRow> method_keys();         // method
Span<const KeyRow> collectors_keys();     // collectors
Span<const KeyRow> path_keys();           // path
Span<const KeyRow> filter_keys();         // filter
Span<const KeyRow> raymarch_keys();       // raymarch
Span<const KeyRow> particles_keys();      // particles
Span<const KeyRow> optical_depth_keys();  // optical_depth
Span<const KeyRow> photon_grid_keys();    // photon_grid
Span<const KeyRow> later_keys();          // tables of later methods
Span<const KeyRow> output_keys();         // output, animation

/// medium.phase: the type, then the keys of every phase function, each path once.
std::vector<const KeyRow*> phase_keys();

/// A method with keys of its own, and the rows of its table.
struct MethodKeys {
    const char* name;
    Span<const KeyRow> (*rows)();
};
Span<const MethodKeys> all_methods();

/// All rows in the order of the documentation.
std::vector<const KeyRow*> all_scene_keys();

/// Calls `visit` for every row that has a field, in every medium, solid and light, with its path
/// ("medium.0.albedo") and where its value stands.
using KeyVisit = std::function<void(const KeyRow&, const std::string& path, const KeySource&)>;
void for_each_key(const Scene& scene, const KeyVisit& visit);

}  // namespace pileus
