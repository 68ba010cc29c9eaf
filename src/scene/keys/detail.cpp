// SPDX-License-Identifier: Apache-2.0
// Keys of detail beyond a medium's grid.
// in: checked values <-> out: fields of DetailSettings.
// docs/detail.md
#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

template <auto Member>
constexpr KeyField detail = field<&MediumSettings::detail, Member>;

constexpr KeyRow kRows[] = {
    {"medium.N.detail.tile_m", detail<&DetailSettings::tile_m>, above(0, 1e9), "m",
     "length after which the noise repeats; required in this table, and left out with it: no "
     "detail (docs/detail.md)",
     kNoNote},
    {"medium.N.detail.strength", detail<&DetailSettings::strength>, from_to(0, 1), "",
     "how far the noise changes a density: at 1 down to nothing; 0: no detail"},
    {"medium.N.detail.dense", detail<&DetailSettings::dense>, from_to(0, 1), "",
     "share of the strength that is left at the largest density; linear below it"},
    {"medium.N.detail.noise", detail<&DetailSettings::noise>, one_of("perlin|worley"), "",
     "kind of noise: wisps, or round lumps"},
    {"medium.N.detail.octaves", detail<&DetailSettings::octaves>, from_to(0, 6), "",
     "octaves of the noise, the first of 4 lumps a tile, each half as large and strong as the one "
     "before; 0: down to four cells a lump"},
    {"medium.N.detail.seed", detail<&DetailSettings::seed>, from_to(0, 0x1p32 - 1), "",
     "another noise for each number"},
    {"medium.N.detail.cells", detail<&DetailSettings::cells>, from_to(16, 128), "cells",
     "cells along the tile's edges: a power of two"},
    {"medium.N.detail.refine", detail<&DetailSettings::refine>, from_to(0, 16), "cells",
     "0: the detail is made while marching, for methods that march through one medium; else it is "
     "laid on a grid in which each cell becomes so many along each axis, for any method"},
};

}  // namespace

Span<const KeyRow> detail_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
