// SPDX-License-Identifier: Apache-2.0
// Whether there are meshes: a flight, which has none, is compiled with a header in place of this.
// in: what kernels are handed -> out: whether meshes are to be met, or dim light.
// docs/flight.md, "Build"
#pragma once
#include "kernels_cpu/core/lanes.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Of a SolidsView.
template <class Solids>
PILEUS_FN bool has_meshes(const Solids& solids) {
    return solids.count > 0;
}

/// `shares`: of light that meshes leave at each place, null without meshes.
PILEUS_FN bool dimmed_by_meshes(const float* shares) { return shares != nullptr; }

}  // namespace PILEUS_ISA
}  // namespace pileus
