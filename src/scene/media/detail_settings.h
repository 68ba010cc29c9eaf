// SPDX-License-Identifier: Apache-2.0
// Detail beyond a medium's grid as a scene asks for it: a tile of noise, how strong, and where.
// in: keys of medium.detail -> out: plain values.
// docs/detail.md
#pragma once
#include <cstdint>

namespace pileus {

enum class DetailNoise { kPerlin, kWorley };

struct DetailSettings {
    double tile_m = 0;  ///< after which the noise repeats; 0: no detail
    double strength = 0.6;
    double dense = 0.25;  ///< share of the strength that is left at the largest density
    DetailNoise noise = DetailNoise::kPerlin;
    int octaves = 0;  ///< 0: as many as the cells show
    std::int64_t seed = 0;
    double age = 0;  ///< lives of the lumps that have passed: a whole one later all are others
    int cells = 64;  ///< of the tile, along each edge: a power of two
    int refine = 0;  ///< 0: made while marching; else cells that each cell becomes along an axis

    bool present() const { return tile_m > 0 && strength > 0; }
    bool is_marched() const { return present() && refine == 0; }
};

/// Lumps of the first octave along a tile.
constexpr int kDetailLumps = 4;

}  // namespace pileus
