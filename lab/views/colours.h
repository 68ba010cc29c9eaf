// SPDX-License-Identifier: Apache-2.0
// Colours for numbers: maps from [0, 1] and a wheel of names, in linear light.
// in: a share or an index -> out: linear R G B in [0, 1].
// Smith, van der Walt 2015 ("inferno", "viridis" of matplotlib, nine steps each).
#pragma once
#include <cstdint>

#include "src/scene/scene.h"

namespace pileus {

enum class ColourMap {
    kHeat,  ///< black, violet, orange, pale yellow: amounts
    kSize,  ///< violet, teal, green, yellow: sizes and depths
};

/// Colour of `share`, held to [0, 1]; between the steps of the map linearly in light.
Float3 map_colour(ColourMap map, float share);

/// One of twelve distinct colours, neighbours in index far apart.
Float3 name_colour(std::uint32_t index);

/// Linear light of an 8-bit sRGB code: the middle of the values that are written as it.
float linear_of_code(std::uint32_t code);

}  // namespace pileus
