// SPDX-License-Identifier: Apache-2.0
// Calls one test at every lane width, and moves numbers between arrays and lanes.
// in: a function template over W -> out: it runs for W = 1, 4, 8, 16.
// kernels_cpu/core/lanes.h
#pragma once
#include <cstring>

#include "kernels_cpu/core/lanes.h"

#define PILEUS_EACH_WIDTH(function) function<1>(), function<4>(), function<8>(), function<16>()

namespace pileus {

/// Exhaustive loops visit each `kThin`-th block where the machine is usually an emulated one.
#if defined(__x86_64__)
constexpr std::uint32_t kThin = 1;
#else
constexpr std::uint32_t kThin = 16;
#endif

inline float float_of(std::uint32_t bits) {
    float f;
    std::memcpy(&f, &bits, 4);
    return f;
}
inline std::uint32_t bits_of_float(float f) {
    std::uint32_t bits;
    std::memcpy(&bits, &f, 4);
    return bits;
}

/// W lanes from `values[0..W)`.
template <class T, class S>
T from_array(const S* values) {
    T v{};
    for (int i = 0; i < width_of<T>; ++i) set_lane(v, i, values[i]);
    return v;
}

}  // namespace pileus
