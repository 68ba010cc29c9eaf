// SPDX-License-Identifier: Apache-2.0
// How much sunlight reaches a height, and what light comes there from all around.
// in: Air -> out: tables over height and the sun's elevation, made once for any sun.
// Orders of scattering by discrete directions and
// harmonics, docs/atmosphere.md.
#pragma once
#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/world/atmosphere/air.h"

namespace pileus {

constexpr int kAroundRows = 16, kAroundColumns = 32;  ///< height, the sun's elevation
constexpr int kAirBands = 6;                          ///< degrees 0 to 5
constexpr int kAirTerms =
    kAirBands * (kAirBands + 1) / 2;  ///< orders 0 to the degree, even in azimuth

struct AirTables {
    Air air{};
    /// [row][column][term][4]: harmonics of the radiance that comes from all around, for an
    /// irradiance of 1 above the air; about the vertical, azimuth 0 towards the sun.
    Buffer<float> around;
    /// [column][4]: irradiance of the sky on level ground.
    Buffer<float> ground;
    bool present() const { return !around.empty(); }
};

/// The same bits for any number of threads. kLimit: out of memory.
Status make_air_tables(const Air& air, int threads, AirTables& tables);

/// Share of the sun's light at a distance `r_km` from the earth's middle, the sun at this cosine
/// to the vertical: its disc sets behind the earth. e^-depth with the depth right within 1e-4 of it
/// (column_to_space).
void sunlight_at(const AirTables& tables, double r_km, double cosine, float (&share)[3]);

/// The value of every harmonic in a direction: cosine to the vertical, cosine of the azimuth.
void air_harmonics(double cosine, double east, float (&y)[kAirTerms]);

/// Scattered towards a direction with these harmonics of what comes from all around: by air and by
/// haze, radiance per km over their coefficients.
void scattered_at(const AirTables& tables, float height_km, float sun_cosine,
                  const float (&y)[kAirTerms], float (&by_air)[3], float (&by_haze)[3]);

/// Irradiance of the sky on level ground, and the sun at this cosine.
void ground_light(const AirTables& tables, float sun_cosine, float (&irradiance)[3]);

/// Distance along a ray to a sphere around the earth's middle: the far meeting, or the near one;
/// below 0: none ahead.
double way_to_sphere(double r_km, double cosine, double sphere_km, bool far);

/// Ends of steps along a ray that begins at `first` and ends at `last`, as shares of it: dense air
/// lies near a low observer, and near the ground for a ray that comes down from high up.
double step_end(double share, bool from_above);

// Light that clear air scatters again and again, by orders.

/// Fills `around` and `ground` of tables that have their sunlight.
Status add_orders(int threads, AirTables& tables);

/// Where a height and a sun lie in the tables, in [0, 1]: rows close to the ground, columns close
/// around the horizon, from 21 degrees below it.
double around_row(double height_km);
double around_column(double sun_cosine);

}  // namespace pileus
