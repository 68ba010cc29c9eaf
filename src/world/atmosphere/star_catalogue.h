// SPDX-License-Identifier: Apache-2.0
// The brightest stars: all of magnitude 2.5 and more, and some that make figures of the sky.
// in: nothing -> out: a table. Places of J2000 to 0.02 degrees, as catalogues have them (Hoffleit
// 1991); doubles that no eye parts are one. Planets are none of them.
#pragma once
#include "src/base/span.h"

namespace pileus {

struct CatalogueStar {
    const char* name;
    double right_ascension_deg, declination_deg;
    double magnitude, colour;  ///< V, B - V
};
/// By magnitude.
Span<const CatalogueStar> bright_stars();

}  // namespace pileus
