// SPDX-License-Identifier: Apache-2.0
// How much air, haze and ozone lies along straight ways through the round air: closed forms.
// in: a ray -> out: columns, in km of the density that coefficients are for.
// Chapman 1931; docs/atmosphere.md, "Columns". Every column of the round air is worked out here,
// every one of level air in kernels_cpu/display/level_air.h.
#pragma once
#include "src/world/atmosphere/air.h"

namespace pileus {

struct AirColumn {
    double air, haze, ozone;  ///< km
};

/// To the end of the air, from a distance from the earth's middle, at a cosine to the vertical: a
/// way that misses the ground. Relative error of each below 1e-4 for any height and direction.
AirColumn column_to_space(double r_km, double cosine);

/// Columns of one piece of a ray after the other.
class AirWalk {
public:
    AirWalk(double r_km, double cosine, double from_km);
    /// From the last end on to `end_km` along the ray, not before it.
    AirColumn to(double end_km);

private:
    double square_;  ///< of the least distance from the earth's middle
    double level_;   ///< where along the ray that is, before its begin
    double at_;      ///< the last end, from there on
    AirColumn outward_;
};

/// What a piece of air scatters of light that is 1 all along it, by band, and what it leaves of
/// light behind it.
struct AirPiece {
    float depth[3], by_air[3], by_haze[3], left[3];
};
AirPiece piece_of(const Air& air, const AirColumn& column);

}  // namespace pileus
