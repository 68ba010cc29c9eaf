// SPDX-License-Identifier: Apache-2.0
// In place of the header of the same path: the ground of a flight is grey land.
#pragma once
#include "kernels_cpu/core/lanes.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <class Paint>
PILEUS_FN bool is_painted(const Paint&) {
    return false;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
