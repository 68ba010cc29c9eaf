// SPDX-License-Identifier: Apache-2.0
// A procedural sky for the kernel that evaluates it in place, with a grid for what cannot.
// in: a scene whose one medium is a sky -> out: Medium with optics and a place, SkyField.
// docs/skies.md, "Evaluated directly".
#pragma once
#include "src/plan/memory_table.h"
#include "src/run/context.h"
#include "src/world/density/sky_field.h"
#include "src/world/medium/medium.h"

namespace pileus {

/// Whether the scene's medium is evaluated directly.
bool is_direct_sky(const Scene& scene);

/// The medium, but no values. Without bounds_m its box is one around the camera, and the layer goes
/// on beyond. Errors: those of outline_medium.
Status outline_sky(const Scene& scene, const Limits& limits, Medium& medium, MediumSource& source);

/// The same with its noises, and with a grid of the box for what reads grids: shadows on what
/// stands below, nodes of sunlight. Errors: those of load_medium.
Status load_sky(const Scene& scene, const Context& context, Medium& medium, SkyField& sky);

/// The noises; `last` uses them last.
void add_sky_rows(const SkySettings& settings, Stage last, MemoryTable& table);

}  // namespace pileus
