// SPDX-License-Identifier: Apache-2.0
// Point, spot and parallel lights as kernels take them.
// in: src/world/light/lights.h -> out: plain structs of fixed-width numbers.
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
    float radius;           ///< of a sphere that casts soft shadows, m; 0: a point for shadows
    std::int32_t places;    ///< on the sphere, where they are not drawn at random
};

/// Lamps and the sun whose photons' directions are kept by degrees about their own axis, at most.
constexpr int kMaxLampAxes = 4, kMaxAxes = 1 + kMaxLampAxes;

/// What the light of one source is spread about at a place: the way that it came straight.
struct LightAxis {
    std::int32_t placed;  ///< 1: away from `at`, m, box-local; 0: along `at`, unit, everywhere
    float at[3];
};

/// How photons leave a lamp. Directions are even over a cone, or as the spot shines; those of a
/// parallel light begin on the box's faces.
struct LampEmission {
    LampParams lamp;
    float below;            ///< share of the lamps' power that comes before this one's, in [0, 1)
    float axis[3];          ///< of the cone, unit
    float span;             ///< 1 - cosine of the cone's half angle; 2: all around; 0: a spot
    float face_cdf[6];      ///< as TraceParams has it; parallel only
    std::int32_t own_axis;  ///< which of the lamps' axes is its own; -1: it has none
};

}  // namespace pileus
