// SPDX-License-Identifier: Apache-2.0
// What a host's own world needs of a sky: shadows of clouds on it, the light at places, the air
// along a way.
// in: a sky and its clouds as the last picture showed them, places -> out: numbers.
// docs/whole-sky.md
#pragma once
#include "src/clouds/clouds.h"

namespace pileus {

/// Light at a place, and what the air there holds.
struct PlaceLight {
    float sun_share = 0;           ///< of sunlight that clouds let through; 0: below the horizon
    std::array<float, 3> sun{};    ///< irradiance on a plane that faces it, through air and clouds
    std::array<float, 3> level{};  ///< of the sky on level ground, without clouds
    /// Irradiance over pi of sky and ground on a plane of normal (x, y, z): the sum of these times
    /// 1, x, y, z, xy, yz, zx, xx - yy, 3 zz - 1.
    std::array<std::array<float, 9>, 3> around{};
    double extinction_per_m = 0;  ///< of clouds and layers there
};

/// Errors: a session's.
Status light_at(Session& sky, Clouds& clouds, Span<const Double3> places, Span<PlaceLight> out);

enum class ShadowFormat { kR8, kRgba8, kR16F, kR32F };

/// The share of sunlight on texels of a map whose rows run from west to east, the first in the
/// north or, `bottom_up`, in the south. Rows [first, first + count) are written.
struct ShadowMapTarget {
    Rows rows;
    ShadowFormat format = ShadowFormat::kR8;
    int width = 0, height = 0, first = 0, count = 0;
    double low_m[2] = {}, size_m[2] = {};  ///< south-west corner; > 0
    double altitude_m = 0;                 ///< of all texels, where there are no heights
    const float* heights = nullptr;        ///< [row as in memory][column], altitudes in m
};
Status draw_shadow_map(Session& sky, Clouds& clouds, const ShadowMapTarget& target);
/// Bytes of a texel.
std::size_t texel_bytes(ShadowFormat format);

/// What the air between the eye and a distance leaves of light, and sends.
struct AirWay {
    std::array<float, 3> left{1, 1, 1}, light{};
};
/// `direction` as the camera's rays; metres > 0, infinity: to the end of the air.
Status air_along(Session& sky, const Double3& direction, double metres, AirWay& out);

}  // namespace pileus
