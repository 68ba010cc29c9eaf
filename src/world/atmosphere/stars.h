// SPDX-License-Identifier: Apache-2.0
// Stars as a place sees them at a moment.
// in: how the sky is turned -> out: directions and irradiances, the Milky Way's band.
// docs/atmosphere.md, "Night": the brightest stand where they do, fainter ones by chance.
#pragma once
#include <array>

#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/base/vectors.h"
#include "src/scene/frame_state.h"

namespace pileus {

/// Stars of magnitude 6.5 and more, of all the sky.
constexpr int kStars = 8768;
/// One star of magnitude 10 per square degree: radiance over the sun's irradiance.
constexpr double kStarOfTen = 6.65e-12;

struct Star {
    float to[3];     ///< unit vector, east, north, up, with refraction; as far down as 4 degrees
    float light[3];  ///< irradiance over the sun's, above the air
};

struct Stars {
    Buffer<Star> stars;
    std::array<Double3, 3> galaxy{};  ///< towards its middle, along its plane, its pole: level axes
    Double3 even{};                   ///< mean radiance of all the sky's, over the sun's irradiance
    double sidereal_deg = 0, latitude_deg = 0, centuries = 0;  ///< that they were turned for

    bool present() const { return !stars.empty(); }
};

/// Turns them; those that are turned so already stay. None where the night has none. kLimit: out of
/// memory.
Status turn_stars(const Night& night, Stars& stars);

/// Radiance over the sun's irradiance of stars too faint for `Stars`, in this direction.
double milky_way(const Stars& stars, const Double3& to);

/// R G B of a colour B - V of luminance 1, where the sun's is white.
std::array<double, 3> star_colour(double colour);

}  // namespace pileus
