// SPDX-License-Identifier: Apache-2.0
// What the kernel of a procedural cumulus needs: plain structs and pointers.
// in: a grid, the spheres of a cloud -> out: the layout of a launch.
// docs/performance.md, "Preparation"
#pragma once
#include <cstdint>

namespace pileus {

/// A sphere, in units of the box's height; z above the cloud base.
struct Bubble {
    float x, y, z, r;
};

constexpr std::int32_t kMaxBubbles = 8192;  // clouds take 1000 to 3100

struct CumulusParams {
    const Bubble* bubbles;
    std::int32_t count;
    std::int32_t size[3];  ///< cells; the outermost layer of them stays empty
    float cell[3];         ///< edge lengths of a cell
    float corner[3];       ///< centre of cell 0
    float voxel;           ///< longest edge
    float shell;           ///< width of the edge of the cloud
    float top;             ///< highest point over the base
    std::uint32_t seed;
    std::int32_t rows_y;  ///< rows of blocks in a layer of them
};

struct CumulusBuffers {
    float* density;         ///< [z][y][x]
    std::int32_t* scratch;  ///< of one thread: kCumulusScratch numbers
};
constexpr std::int32_t kCumulusScratch = 3 * kMaxBubbles;

constexpr int kCumulusBlock = 8;  // cells along a block's edge

// Lengths in units of the box's height.
constexpr float kCumulusWarp = 0.030f;     // largest shift of a point by the warp, per axis
constexpr float kCumulusPushIn = 0.044f;   // largest displacement of the surface inwards
constexpr float kCumulusPushOut = 0.024f;  // and outwards

}  // namespace pileus
