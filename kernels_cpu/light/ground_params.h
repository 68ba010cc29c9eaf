// SPDX-License-Identifier: Apache-2.0
// What the level ground looks like: a map of its albedo, or a sea.
// in: the scene's [ground] -> out: the layout that kernels take. docs/ground.md
#pragma once
#include <cstdint>

#include "kernels_cpu/light/sky_map.h"

namespace pileus {

/// Halvings of a map of albedos, each half as fine as the one before.
constexpr int kGroundLevels = 16;

/// Albedo over a rectangle of the ground, bilinear between the middles of texels.
struct GroundMapView {
    std::int32_t columns, rows;  ///< of the finest level; no columns: none
    std::int32_t planes;         ///< 1 (grey) or 3
    std::int32_t levels;
    std::int32_t repeats;               ///< 1: beyond its edges the map begins again
    std::int32_t first[kGroundLevels];  ///< texel at which each level begins
    std::int32_t texels;                ///< of all levels: numbers of a plane
    float to_column[3], to_row[3];      ///< of x, y and 1: box-local metres to texels of level 0
    float texel_m;                      ///< the longer edge of one
    const float* albedo;                ///< [plane][level][row][column]
};

/// Intervals of the tables of a sea, and how far the second reaches.
constexpr int kSeaCosines = 64;
constexpr float kSeaSeen = 4;
/// Slopes at which a sea is looked at along a view and across it.
constexpr int kSeaAlong = 7, kSeaAcross = 3;
constexpr int kSeaWaves = 20;

/// A rough sea: Gaussian slopes, alike in all directions (Cox and Munk 1954).
struct SeaView {
    float slope;                      ///< standard deviation of the slope along any axis
    float fine;                       ///< the same without the waves that are shown one by one
    float reflects[kSeaCosines + 1];  ///< mean over the facets that are seen, by cosine of the view
    /// Of facets that lean by a normal number, seen at x: the mean of max(x + it, 0), x in
    /// [0, kSeaSeen].
    float seen[kSeaCosines + 1];
    float along[kSeaAlong], along_weight[kSeaAlong];      ///< of a normal distribution
    float across[kSeaAcross], across_weight[kSeaAcross];  ///< likewise
};

/// Waves that are shown one by one.
struct SeaWaves {
    float x[kSeaWaves], y[kSeaWaves], phase[kSeaWaves];  ///< turns per metre; turns
    float lean_x[kSeaWaves], lean_y[kSeaWaves];          ///< largest slopes
    float per_length[kSeaWaves];                         ///< 1/m
    /// Two slow patterns, likewise, and how many turns each moves a wave: no two crests are alike.
    float slow_x[2], slow_y[2], slow_phase[2];
    float bend[kSeaWaves][2];
};

struct GroundPaint {
    std::int32_t on;  ///< 0: grey, of the albedo that radiances are made with
    float share[3];   ///< albedo over that, where there is no map
    float share_sun;  ///< the same of the sun's light alone, times share
    float per_albedo;
    float texel_turn;  ///< angle between pixels' rays: chooses the map's level; 0: the finest
    GroundMapView map;
    const SeaView* sea;  ///< null: none
    SeaWaves waves;
    // What a sea mirrors; not read by paths.
    float sun[3];    ///< irradiance on a plane that faces the sun
    SkyMapView sky;  ///< all around; no columns: radiance `even`
    float even[3];
    float mirror_m;        ///< above the sea where the map's things stand; 0: all are far away
    float mirror_from[3];  ///< where the map was seen from, m, box-local
};

}  // namespace pileus
