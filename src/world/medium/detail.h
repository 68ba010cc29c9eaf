// SPDX-License-Identifier: Apache-2.0
// Detail beyond a medium's grid: the tile of noise that marches read, or a finer grid that has it.
// in: a medium with its density, the scene's words about detail -> out: the same mean, more detail.
// docs/detail.md
#pragma once
#include "src/world/medium/medium.h"

namespace pileus {

/// Makes the tile: (cells + 1)^3 numbers >= -1 whose mean over a period is 0. kLimit: memory.
Status make_detail_tile(const DetailSettings& settings, const KernelTable& kernels, int threads,
                        Buffer<float>& tile);

/// What detail does to a medium that is outlined: its size, and memory while it is made. kLimit:
/// more voxels than the limits allow; kBadInput: more tiles than 65536 along the box.
Status outline_detail(const Scene& scene, const MediumSettings& settings, const Limits& limits,
                      Medium& medium, MediumSource& source);

/// Gives a loaded medium its detail: the tile, or with `refine` a finer density. Does nothing where
/// the scene asks for none. kLimit: memory; kBadInput as above.
Status add_detail(const Scene& scene, const MediumSettings& settings, int threads,
                  const KernelTable* kernels, Medium& medium);

/// kBadInput where a scene has detail that is made while marching: `who` knows it on a grid alone.
Status refuse_marched_detail(const Scene& scene, const std::string& who);

/// What the plan says of it; empty: there is none.
std::string told_detail(std::size_t name, const DetailSettings& settings);

}  // namespace pileus
