// SPDX-License-Identifier: Apache-2.0
// Whether the ground has a map, colours or a sea: a flight, which has none, is compiled with a
// header in place of this. docs/flight.md, "Build"
#pragma once
#include "kernels_cpu/core/lanes.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Of a GroundPaint.
template <class Paint>
PILEUS_FN bool is_painted(const Paint& paint) {
    return paint.on != 0;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
