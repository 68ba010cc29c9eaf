// SPDX-License-Identifier: Apache-2.0
// A small cloud that every method shows, whose phase function is a table.
// in: nothing -> out: the text of a scene.
#pragma once

constexpr const char* kFlightScene = R"(
[camera]
position_m = [16, -4000, 256]
target_m = [0, 0, 1024]
resolution = [24, 16]
[sun]
azimuth_deg = 120
elevation_deg = 35
[sky]
radiance = [0.05, 0.07, 0.11]
[ground]
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-512, -512, 512], [512, 512, 1536]]
resolution = [16, 16, 16]
extinction_per_m = 0.02
phase = { type = "cloud", effective_radius_um = 10 }
[collectors]
photons = 2000
generations = 4
[photon_grid]
photons = 2000
generations = 4
[path]
samples_per_pixel = 1
)";
