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
    Buffer<float> slices;
    int channel = -1;  ///< whose ways through nodes the work holds
};

/// `beam`: of an irradiance of 1; null: none. `moments`: [moment][node], out. kLimit: out of
/// memory.
Status solve_ordinates(const Context& context, const Medium& medium, const OrdinateNodes& nodes,
                       const OrdinateOptics& optics, const Lighting& lighting, const float* beam,
                       OrdinateSolver& solver, OrdinateSet& set, float* moments);

}  // namespace pileus
