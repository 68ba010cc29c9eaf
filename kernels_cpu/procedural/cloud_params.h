// SPDX-License-Identifier: Apache-2.0
// What the kernel of procedural clouds needs: plain structs and pointers. All lengths in metres,
// from the middle of the cloud's foot on its condensation level.
// in: a grid, the balls of a cloud -> out: the layout of a launch.
// docs/generators.md
#pragma once
#include <cstdint>

namespace pileus {

/// A ball of rising air. `vigour` in [0, 1]: how fresh it is, crisp where it is 1.
struct CloudBall {
    float x, y, z, r;
    float vigour;
    float join, unjoin;  ///< width over which it blends with others, and 1/(4 join)
    float spare;
};
constexpr int kCloudBallFloats = 8;
static_assert(sizeof(CloudBall) == 4 * kCloudBallFloats, "balls are read as rows of floats");

constexpr std::int32_t kMaxCloudBalls = 4096;  // clouds take 200 to 2500

struct CloudParams {
    const CloudBall* balls;
    std::int32_t count;
    std::int32_t size[3];           ///< cells of the grid
    std::int32_t begin[3], end[3];  ///< cells to fill
    std::int32_t rows_y;            ///< rows of blocks in a layer of them
    float cell[3];                  ///< edge lengths of a cell
    float corner[3];                ///< centre of cell 0
    float voxel;                    ///< longest edge
    std::uint32_t seed;
    std::int32_t all_balls;    ///< 1: no list is shortened, for tests
    float height;              ///< of the tallest top
    float bend, bend_per_m;    ///< largest bend of an octave of 1, and 1 over its cell
    float plan, plan_per_m;    ///< the same of the outline seen from above
    float join, vigour_reach;  ///< largest `join`; reach of a ball's vigour
    float lump;                ///< cell of the first octave
    std::int32_t octaves;
    float erosion;        ///< share of a cell that each octave takes off
    float age, dilution;  ///< 0 to 1; 0 and more
    float entrainment;    ///< 1/m: share of outside air that a rising parcel takes in
    float lift;           ///< metres that lumps have risen
    float water;          ///< share that is left of a cloud that dies
    float soft, crisp;    ///< widths of a calm edge and of a fresh one
    float per_full;       ///< 1 over the height at which the density is 1
    float saturation;     ///< 1/m: height counts as z/(1 + z saturation), as water rains out
    // A spreading top of ice: flat above, thinning to a rim, drawn out downwind; radius 0: none.
    float anvil_radius, anvil_top, anvil_depth;
    float anvil_sunk;        ///< how far its surface lies within, while it comes
    float anvil_x, anvil_y;  ///< its middle
    float wind_x, wind_y;    ///< unit vector
    float mamma;             ///< metres that pouches hang down; 0: none
    float shelf;             ///< metres that the base's lip hangs down; 0: flat
    float shelf_x, shelf_y;  ///< unit vector to the lip
    float foot;              ///< half the width of the heap's foot
};

struct CloudBuffers {
    float* density;         ///< [z][y][x]; what is there already stays where it is more
    std::int32_t* scratch;  ///< of one thread: kCloudScratch numbers
};
constexpr std::int32_t kCloudScratch = 2 * kMaxCloudBalls;

/// Rain that falls out of a part of a base.
struct RainShaft {
    float x, y, r;
};
constexpr int kMaxRainShafts = 8;

struct CloudRainParams {
    RainShaft shafts[kMaxRainShafts];
    std::int32_t count;  ///< 0: patches of rain under all of a layer
    std::int32_t size[3];
    std::int32_t layers;  ///< of cells to fill, from the lowest on
    float cell[3];
    float corner[3];  ///< centre of cell 0
    std::uint32_t seed;
    float strength;           ///< root of the extinction at the base over that of 50 mm/h
    float lost_per_m;         ///< how much of that root a metre of dry air takes
    float full;               ///< density of rain of 50 mm/h
    float depth;              ///< from the base to the ground
    float lean_x, lean_y;     ///< how far streaks trail over how far they fell
    float plan, plan_per_m;   ///< bends of the outline of the heap above
    std::uint32_t plan_seed;  ///< of these
    float fallen;             ///< metres that streaks have fallen
    float top;                ///< height over the base at which rain has faded into the cloud
    // Of the three octaves of streaks: 1 over their width and length, cells after which they
    // repeat.
    float per_x[3], per_y[3], per_z[3];
    std::int32_t period_x[3], period_y[3];
};

struct CloudRainBuffers {
    float* density;  ///< [z][y][x]; what is there already stays where it is more
};

constexpr int kCloudBlock = 8;  // cells along a block's edge

/// Layers, which are periodic over their box along x and y.
enum CloudLayerForm : std::int32_t {
    kLayerClosed,   ///< cells with rising air in their middle
    kLayerOpen,     ///< rising air along the walls of cells
    kLayerSheet,    ///< an even sheet
    kLayerStreaks,  ///< ice that falls out of heads and is drawn out by shear
};

struct CloudLayerParams {
    std::int32_t form;  ///< CloudLayerForm
    std::int32_t map;   ///< 1: fill the map of rising air, 0: the densities by it
    std::int32_t size[3];
    float cell[3];
    float lowest;    ///< height of the lowest cells' middles over the base
    float width[2];  ///< edges of the box along x and y
    std::uint32_t seed;
    float height;    ///< thickness of the layer
    float length;    ///< of a cell, or of a streak's head
    float gap;       ///< rising air at clouds' rims
    float grounded;  ///< 1: no base, cloud down to the floor
    float lump;      ///< cell of the first octave
    std::int32_t octaves;
    float erosion, act;
    float edge;      ///< width of the edge
    float shear;     ///< drift over height fallen
    float turn;      ///< that the wind veers over the height, in turns
    float per_full;  ///< 1 over the height at which the density is 1; 0: all of it
};

struct CloudLayerBuffers {
    float* density;  ///< [z][y][x]
    float* map;      ///< [y][x]
};

/// A moist layer that a standing wave lifts over its condensation level: a lens around its rim.
struct CloudPlate {
    float rim;            ///< height of the rim over the base
    float over, under;    ///< thickness over and under the rim, in the middle
    float x, y;           ///< its middle, along the wind and across
    float along, across;  ///< radii; downwind `lee` times the former
};
constexpr int kMaxCloudPlates = 12;

struct CloudLensParams {
    CloudPlate plates[kMaxCloudPlates];
    std::int32_t count;
    std::int32_t size[3];
    float cell[3];
    float corner[3];  ///< centre of cell 0
    float wind_x, wind_y;
    std::uint32_t seed;
    float lee;                   ///< how much longer lenses are downwind
    float outline, per_outline;  ///< bends of the rim over its radius; 1 over their length
    float striae, per_stria;     ///< the same of thin layers, by height
    float edge;                  ///< width of the edge
};

struct CloudLensBuffers {
    float* density;  ///< [z][y][x]
};

}  // namespace pileus
