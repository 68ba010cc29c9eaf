// SPDX-License-Identifier: Apache-2.0
// Floats to whole quanta, so that sums do not depend on their order.
// in: value and 2^s -> out: round(value * 2^s), half away from zero, as int32.
// docs/methods.md 2 (accumulation); the plan proves that the 64-bit sums cannot overflow.
#pragma once
#include "kernels_cpu/core/lanes.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Clamped before the conversion to +-2147483520: what an out-of-range conversion gives differs
/// between machines. NaN gives +2147483520. The addend is the float below one half: with one half
/// itself the sum would round 0.49999997 and every odd whole number from 2^23 to 2^24 up.
template <class T>
PILEUS_FN auto quantise(T value, float scale) {
    const T limit = all<T>(2147483520.0f);
    const T scaled = value * scale;
    const T rounded = scaled + copysign_(all<T>(0x1.fffffep-2f), scaled);
    return to_int(max_(min_(rounded, limit), T{} - limit));
}

}  // namespace PILEUS_ISA
}  // namespace pileus
