// SPDX-License-Identifier: Apache-2.0
// In place of the header of that path: no meshes are in a flight.
// in: nothing -> out: constants. docs/flight.md, "Build"
#pragma once
#include "kernels_cpu/core/lanes.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <class Solids>
PILEUS_FN constexpr bool has_meshes(const Solids&) {
    return false;
}
PILEUS_FN constexpr bool dimmed_by_meshes(const float*) { return false; }

}  // namespace PILEUS_ISA
}  // namespace pileus
