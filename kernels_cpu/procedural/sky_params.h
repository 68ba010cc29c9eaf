// SPDX-License-Identifier: Apache-2.0
// What the kernels of procedural skies need: noise volumes, their packed levels, the cloud layer.
// in: a scene's sky -> out: the layout of a launch. Filled by src/world/density.
// docs/skies.md; Palenik 2016, section 5.1.
#pragma once
#include "kernels_cpu/procedural/cumulus_params.h"

namespace pileus {

/// A periodic sum of octaves of lattice noise over size^3 texels.
struct NoiseParams {
    std::int32_t kind;     ///< NoiseKind
    std::int32_t size;     ///< texels along each edge, a power of two
    std::int32_t cells;    ///< lattice cells of the first octave along each edge
    std::int32_t octaves;  ///< each twice as fine as the one before
    float gain;            ///< size of an octave over that of the one before
    std::uint32_t seed;
};
struct NoiseBuffers {
    float* values;  ///< [z][y][x]
};
enum NoiseKind : std::int32_t { kNoisePerlin, kNoiseWorley };

/// Edge of the blocks whose largest values are kept, in texels of their level.
constexpr std::int32_t kNoiseBlock = 4;
constexpr int kMaxNoiseLevels = 10;  ///< 512 texels and all halvings

/// A noise volume ready to be read: per texel one word of four bytes, the values at (x, y),
/// (x+1, y), (x, y+1), (x+1, y+1), around the ends; levels of halved size behind one another.
struct NoiseView {
    const std::int32_t* words;    ///< level of size m from noise_level_start(m) on
    const std::int32_t* largest;  ///< a byte per block, lowest first; levels as those of texels
    std::int32_t size, last;      ///< of level 0; number of the last level
    float per_m;                  ///< tiles per metre
    float offset[3];              ///< of the origin, in tiles
    float turn[2];                ///< cosine and sine from the world's axes to the tile's
    float share;                  ///< of the blend: gain times weight, over 255; 0: not read
    float most;                   ///< share times the largest value
    float lost[kMaxNoiseLevels];  ///< variance of share * value that a level has no more
};

constexpr std::int64_t noise_level_start(std::int64_t m) { return m * m * m / 4; }
constexpr std::int64_t noise_words(std::int64_t size) {
    return noise_level_start(size) + size * size * size;
}
/// Blocks along an edge of a level of m texels; its blocks start where those of a smaller level
/// end, as with the texels.
constexpr std::int32_t noise_blocks(std::int32_t m) {
    return m >= kNoiseBlock ? m / kNoiseBlock : 1;
}

/// Bands of the layer's height, for bounds.
constexpr std::int32_t kSkyBands = 16;

/// The cloud layer: density(place) = ramp(blend of both noises - lift(height)) * weight(height).
struct SkyParams {
    NoiseView perlin, worley;
    float middle, half_width;     ///< of the ramp, in units of the blended noise
    float low_m, inverse_m;       ///< base altitude; 1 / thickness
    float height_m;               ///< thickness
    float rise, fall;             ///< inverse shares of the thickness; 0: cut off
    float rounding;               ///< how much the noise is lowered at base and top
    float base_weight;            ///< density just above the base; 1 at the top
    float shift_m[3];             ///< world coordinates of the medium's low corner
    float curvature_per_m;        ///< 1 / planet radius; 0: flat
    std::int32_t empty;           ///< 1: coverage 0
    float least_lift[kSkyBands];  ///< of each band of the height
    std::int32_t boxed;           ///< 1: nothing beside or outside the box [0, extent_m]
    float extent_m[3];
    float reach_m;  ///< rays are followed so far through the layer
};

/// Nodes of sunlight in a layer: levels around the camera, each of twice the spacing. Node (i, j,
/// n) of a level lies at x, y = (i, j) times its spacing and an n-th of the layer's height; it is
/// kept at (i, j) modulo the nodes along an edge, so that it stays where it is while the camera
/// moves.
constexpr std::int32_t kMaxSkyLightBits = 8;
constexpr std::int32_t kSkyLightHeights = 32;
constexpr int kMaxSkyLightLevels = 12;
constexpr float kSkyLightUnit = 256;  ///< of optical depths, kept in 16 bits
struct SkyLightView {
    /// [level][height][y][x]: the node's depth, and in the high half that of the next along x.
    const std::int32_t* words;
    float spacing_m;  ///< of level 0
    float camera[2];  ///< m, box-local
    float reach_m;    ///< of level 0, along x and y from the camera
    std::int32_t levels;
    std::int32_t bits;        ///< 2^bits nodes along x and y
    std::int32_t near_steps;  ///< marched from the sample itself; nodes hold the others
};
/// A row of nodes to be made: columns [first, last).
struct SkyLightRow {
    std::int32_t level, height, row, first, last;
};

/// Cell centres of a grid over a box.
struct BakeParams {
    SkyParams sky;
    std::int32_t size[3];
    float cell_m[3];
    float width_m;  ///< details below are averaged
};
struct BakeBuffers {
    float* density;  ///< [z][y][x]
};

/// Largest lowered noise in columns strewn over the layer; from it follows the coverage.
struct ColumnParams {
    SkyParams sky;
    std::int32_t heights;  ///< samples up each column
    float reach_m;         ///< columns lie in a square of this edge
};
struct ColumnBuffers {
    float* most;  ///< [column]
};

}  // namespace pileus
