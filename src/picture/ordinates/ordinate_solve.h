// SPDX-License-Identifier: Apache-2.0
// Iterations of discrete ordinates, mixed so that thick media need few.
// in: nodes, light that enters, the beam -> out: moments of the radiance.
// docs/ordinates.md, "Iterations"; Anderson 1965.
#pragma once
#include "src/picture/ordinates/ordinates.h"

namespace pileus {

/// Memory that solutions share, one after the other.
struct OrdinateSolver {
    Buffer<float> work;
    Buffer<float> parts;  ///< [medium][node]: of the extinction that counts; of several alone
    Buffer<float> slices;
    Buffer<std::int32_t> place_x;  ///< of nodes that hold medium, where slices are along x
    int channel = -1;              ///< whose ways through nodes the work holds
};

/// Light that begins in nodes; null: none.
struct OrdinateSources {
    const float* beam = nullptr;   ///< [filled]: of the sun, of an irradiance of 1
    const float* fixed = nullptr;  ///< [direction][filled]
};

/// `iterations`: at most, from set.solved on; 0: all, from none. `moments`: [moment][filled].
/// kLimit: out of memory.
Status solve_ordinates(const Context& context, const Medium& medium, const OrdinateNodes& nodes,
                       const Lighting& lighting, const OrdinateSources& from, int iterations,
                       OrdinateSolver& solver, OrdinateSet& set, float* moments);

}  // namespace pileus
