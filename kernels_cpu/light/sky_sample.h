// SPDX-License-Identifier: Apache-2.0
// Directions drawn from a sky map in proportion to its light, and their density.
// in: random words or a direction -> out: a direction, density per steradian.
// docs/path.md, "Sky maps": texel by its power, then a tent around it, as the map is read.
#pragma once
#include "kernels_cpu/light/sky_map.h"

namespace pileus {

/// Tables beside a SkyMapView of the same rows and columns (src/methods/path/path_sky.h).
struct SkySampler {
    const float* weight;             ///< [row][column], texels' light times the row's mean sine
    const std::int32_t* row_cdf;     ///< as in SkyMapView
    const std::int32_t* column_cdf;  ///< as in SkyMapView
    float density;  ///< per steradian at unit weight and zenith distance 90 degrees
};

inline namespace PILEUS_ISA {

/// Density per steradian of `draw_sky` at the unit vector `d`.
template <class T>
PILEUS_FN T sky_density(const SkyMapView& map, const SkySampler& s, const Vec<T>& d) {
    const T weight = read_map(s.weight, map, place_on_map(map, d));
    const T sine = sqrt_(d.x * d.x + d.y * d.y);
    return weight * s.density / max_(sine, all<T>(1e-12f));
}

/// Unit vector towards the sky. `texel` chooses the texel, `place` the direction around it.
template <class T, class UU>
PILEUS_FN Vec<T> draw_sky(const SkyMapView& map, const SkySampler& s, const Words<UU>& texel,
                          const Words<UU>& place) {
    using II = I_of<T>;
    const II row = pick(s.row_cdf, II{}, map.rows, map.row_bit, texel.a >> 1);
    const II column =
        pick(s.column_cdf, row * map.columns, map.columns, map.column_bit, texel.b >> 1);
    // What passes the zenith or the sky's foot folds back, as the outermost rows reach up to there.
    T p = to_float(row) + 0.5f + tent(uniform(place.a));
    p = abs_(select(p > map.foot, 2.0f * map.foot - p, p));
    const T q = to_float(column) + 0.5f + tent(uniform(place.b));
    const T turn = q * (1.0f / float(map.columns)) + map.turn_of_first;
    const SinCos<T> theta = sincos_turns(p * (1.0f / map.rows_per_turn));
    const SinCos<T> phi = sincos_turns(turn - to_float(floor_int(turn)));
    return {theta.sine * phi.sine, theta.sine * phi.cosine, theta.cosine};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
