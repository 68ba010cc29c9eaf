// SPDX-License-Identifier: Apache-2.0
// The least that tracing can cost: its random numbers, logarithms and random loads, no more.
// in: counts of collisions and crossings -> out: a checksum, the same for every instruction set.
// Read with README.md: a trace's time over its floor's says what all the rest of it costs.
#pragma once
#include <cstdint>

#include "kernels_cpu/isa/kernels.h"

namespace bench {

/// What a trace did, and the arrays it read.
struct FloorWork {
    std::uint32_t tentative, scatterings, crossings;
    std::uint32_t voxels, blocks;
    const float *density, *majorant;
    const std::int32_t* collector;
};

using FloorKernel = std::uint32_t (*)(const FloorWork&);

/// The floor compiled for the instruction set of that name; null where there is none.
FloorKernel floor_kernel(const char* isa);

}  // namespace bench
