// SPDX-License-Identifier: Apache-2.0
// Elementary functions alone, and the least that marching and reconstruction can cost.
// in: arrays and how often to read them -> out: checksums, the same for every instruction set.
// Read with README.md: a stage's time over its floor's says what all the rest of it costs.
#pragma once
#include <cstdint>

namespace bench {

/// A grid of numbers.
struct FloorGrid {
    std::int32_t size[3];
    const float* values;
};

/// What a marched picture read: so many samples of each grid.
struct MarchFloorWork {
    std::uint64_t samples;
    FloorGrid density, sun, source;  ///< one, one and three interpolations a sample
    float apart;                     ///< voxels between the rays of two pixels
};

/// Sums to be scaled and weighted: `numbers` a row.
struct ReconstructFloorWork {
    const std::int64_t* sums;
    std::uint64_t rows, numbers;
};

enum class MathKind { kLog, kExp, kSinCos, kAtan2, kThreefry };

struct LaneFloors {
    std::uint32_t (*march)(const MarchFloorWork&);
    double (*reconstruct)(const ReconstructFloorWork&);
    /// Sum of the bits of the function of `count` numbers in (0, 1]; count a multiple of 16.
    std::uint32_t (*math)(MathKind, const float* x, std::uint32_t count);
};

/// Those compiled for the instruction set of that name; null where there are none.
const LaneFloors* lane_floors(const char* isa);

}  // namespace bench
