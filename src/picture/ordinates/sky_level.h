// SPDX-License-Identifier: Apache-2.0
// One level of nodes of a sky: where it lies, what lies in it, its solutions; and how it is read.
// in: a level, the coarser one -> out: moments on its nodes; light towards the camera.
// docs/ordinates.md, "Skies"
#pragma once
#include "src/picture/ordinates/sky_ordinates.h"

namespace pileus {

constexpr int kMovedNodes = 4;  ///< that a level moves by

SkyPlaces node_places(const SkyLevel& level);

/// Where level `l` lies for a camera; moved by whole nodes.
std::array<double, 2> low_of(const SkyOrdinates& of, std::size_t l, const SkyParams& sky,
                             const CameraParams& camera);

/// What lies in a level that has moved; it has no solution then.
void place_level(const Context& context, const Medium& medium, const SkyOrdinateAsk& ask,
                 const std::array<double, 2>& low, SkyLevel& level);

/// Solves set `only` of the picture's lights, or with -1 all, by the coarser level; null: it is the
/// coarsest. `iterations`: OrdinateAsk's. kLimit: out of memory.
Status solve_level(const Context& context, const Medium& medium, const Majorants& majorants,
                   const Lighting& lighting, const SkyOrdinateAsk& ask, const SkyLevel* coarser,
                   const std::vector<OrdinateSet>& lights, int only, int iterations,
                   Buffer<float>& depths, SkyLevel& level);

/// What the march reads of levels, and light on their nodes towards the camera. kLimit: out of
/// memory.
void set_levels_view(const SkyOrdinateAsk& ask, SkyOrdinates& out);
Status turn_levels(const Context& context, const SkyOrdinateAsk& ask, SkyOrdinates& out);

}  // namespace pileus
