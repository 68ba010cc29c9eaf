// SPDX-License-Identifier: Apache-2.0
// Where media that shine by themselves send out light, as photons draw it.
// in: densities of a medium -> out: how much there is of it, and a table over its voxels.
// docs/methods.md 3, "Shoot"
#pragma once
#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/plan/array.h"
#include "src/world/grid/grid.h"

namespace pileus {

struct Medium;

/// One of a world's media that shines.
struct Emitter {
    int medium = 0;      ///< its number, below kMaxMedia
    double mass_m3 = 0;  ///< integral of its density over the box; of an outlined one a bound
    Buffer<std::uint32_t> below;  ///< share of all voxels before one, in 2^-32; empty: outlined
};

namespace arrays {

inline Array<std::uint32_t> emitted_below(std::uint64_t voxels) {
    return {"where media shine", voxels, Stage::kDensity, Stage::kWrite};
}

}  // namespace arrays

/// Fills medium.emitters, for each medium that shines where there is some of it. An outlined medium
/// has no tables. kLimit: out of memory.
Status make_emitters(Medium& medium);

}  // namespace pileus
