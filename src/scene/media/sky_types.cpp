// SPDX-License-Identifier: Apache-2.0
// What kinds of clouds bring to a procedural sky: layer, shape, extinction, droplets.
// in: a name -> out: a row. Optics: OPAC (Hess et al. 1998), Salby 1996, table 9.2; layers and
// shapes: docs/skies.md, "Kinds of clouds".
#include "src/scene/media/sky_settings.h"

namespace pileus {
namespace {

// name, base, top, coverage, perlin_m, worley_m, blend, A, B, rise, fall, rounding, base density,
// extinction, effective radius
constexpr SkyType kTypes[] = {
    {"custom", 1000, 3000, -1, 8000, 5000, 0.5, 0.5, 0.7, 0, 0, 0, 1, 0, 0},
    {"cumulus", 800, 2300, 0.4, 7000, 1900, 0.65, 0.5, 0.6, 0.1, 0.9, 0.35, 0.4, 0.068, 5.77},
    {"cumulus-maritime", 600, 2000, 0.4, 7000, 1900, 0.65, 0.5, 0.6, 0.1, 0.9, 0.35, 0.4, 0.052,
     12.68},
    {"stratocumulus", 900, 1400, 0.8, 4500, 1300, 0.55, 0.5, 0.68, 0.25, 0.6, 0.25, 0.5, 0.03, 7},
    {"stratus", 400, 800, 0.95, 12000, 5000, 0.8, 0.45, 0.8, 0.4, 0.4, 0.25, 0.6, 0.057, 7.33},
    {"nimbostratus", 500, 3000, 1, 16000, 6000, 0.8, 0.35, 0.75, 0.15, 0.3, 0.25, 0.7, 0.12, 5},
    {"cumulonimbus", 600, 9000, 0.3, 28000, 5000, 0.65, 0.5, 0.58, 0.03, 0.5, 0.3, 0.5, 0.038, 10},
    {"fog", 0, 150, 1, 3000, 1200, 0.7, 0.2, 0.8, 0, 0.7, 0.3, 1, 0.0081, 10.7},
};

}  // namespace

const SkyType& sky_type(const std::string& name) {
    for (const SkyType& type : kTypes)
        if (name == type.name) return type;
    return kTypes[0];
}

}  // namespace pileus
