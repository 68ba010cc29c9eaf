// SPDX-License-Identifier: Apache-2.0
// Point, spot and parallel lights as kernels take them.
// in: src/world/light/lamps.h -> out: plain structs of fixed-width numbers.
// docs/lights.md. Lengths in metres, box-local.
#pragma once
#include <cstdint>

namespace pileus {

struct LampParams {
    std::int32_t parallel;  ///< 1: light from one direction, without a place
    float at[3];            ///< where it stands; parallel: unit vector towards it
    float axis[3];          ///< unit vector along which a spot shines
    float edge;             ///< cosine at its cone's edge; below -1: it shines all around
    float slope;            ///< 1 over the cosine's growth from the edge to full light
    float light[3];         ///< radiant intensity; parallel: irradiance on a plane facing it
    float strength;         ///< the largest of them
    float least_square;     ///< of its radius, m^2, > 0
};

}  // namespace pileus
