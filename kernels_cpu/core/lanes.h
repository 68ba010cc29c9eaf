// SPDX-License-Identifier: Apache-2.0
// W numbers side by side: the only vocabulary in which kernels are written.
// in: W = 1 (plain scalar C++, what a GPU compiler takes), 4, 8, 16 -> out: types F I U M, verbs.
// Operators are the compiler's own (GCC/Clang vector extensions), so the same formula gives the
// same bits at every width.
#pragma once
#include <cstdint>
#include <cstring>

#ifndef PILEUS_ISA
#define PILEUS_ISA host
#endif
// nvcc compiles every function for its device and for the host, with one lane; arrays of constants
// (PILEUS_NUMBERS) must lie on the device.
#if defined(__CUDACC__)
#define PILEUS_FN __host__ __device__ __forceinline__ static
#define PILEUS_NUMBERS static __device__ constexpr
#define PILEUS_CONVERT(v, To) To(v)
#elif defined(PILEUS_COVERAGE) || (defined(PILEUS_FLIGHT) && defined(__OPTIMIZE_SIZE__))
// Counted once for each function, not once for each place that calls it.
#define PILEUS_FN static inline
#define PILEUS_NUMBERS constexpr
#define PILEUS_CONVERT(v, To) __builtin_convertvector(v, To)
#else
#define PILEUS_FN [[gnu::always_inline]] static inline
#define PILEUS_NUMBERS constexpr
#define PILEUS_CONVERT(v, To) __builtin_convertvector(v, To)
#endif

namespace pileus {
inline namespace PILEUS_ISA {

template <int W>
struct LaneTypes;

template <>
struct LaneTypes<1> {
    using F = float;
    using I = std::int32_t;
    using U = std::uint32_t;
    using M = bool;
};

#if !defined(__CUDACC__)
#define PILEUS_LANE_TYPES(W)                                         \
    template <>                                                      \
    struct LaneTypes<W> {                                            \
        typedef float F __attribute__((vector_size(4 * W)));         \
        typedef std::int32_t I __attribute__((vector_size(4 * W)));  \
        typedef std::uint32_t U __attribute__((vector_size(4 * W))); \
        using M = I;                                                 \
    };
PILEUS_LANE_TYPES(4)
PILEUS_LANE_TYPES(8)
PILEUS_LANE_TYPES(16)
#undef PILEUS_LANE_TYPES
#endif

template <int W>
using F = typename LaneTypes<W>::F;
template <int W>
using I = typename LaneTypes<W>::I;
template <int W>
using U = typename LaneTypes<W>::U;
template <int W>
using M = typename LaneTypes<W>::M;

/// Number of lanes of a lane type.
template <class T>
constexpr int width_of = int(sizeof(T) / 4);
template <>
inline constexpr int width_of<bool> = 1;

template <class T>
using F_of = F<width_of<T>>;
template <class T>
using I_of = I<width_of<T>>;
template <class T>
using U_of = U<width_of<T>>;
template <class T>
using M_of = M<width_of<T>>;

/// One lane, read or written.
template <class T>
PILEUS_FN auto lane(const T& v, int i) {
    if constexpr (width_of<T> == 1)
        return (void)i, v;
    else
        return v[i];
}
template <class T, class S>
PILEUS_FN void set_lane(T& v, int i, S s) {
    if constexpr (width_of<T> == 1)
        (void)i, v = s;
    else
        v[i] = s;
}

/// The same number in every lane; minus zero stays minus zero, as x - 0 is x and x + 0 is not.
template <class T, class S>
PILEUS_FN T all(S s) {
    if constexpr (width_of<T> == 1)
        return T(s);
    else
        return s - T{};
}
/// 0, 1, 2, ... W-1.
template <class T>
PILEUS_FN T iota() {
    T v{};
    for (int i = 0; i < width_of<T>; ++i) set_lane(v, i, i);
    return v;
}

template <class To, class From>
PILEUS_FN To reinterpret(From v) {
    static_assert(sizeof(To) == sizeof(From), "lanes of one width");
    if constexpr (sizeof(To) == 4) {
        To r;
        __builtin_memcpy(&r, &v, 4);
        return r;
    } else {
        return (To)v;
    }
}
/// Truncates towards zero; the caller keeps |v| below 2^31.
template <class T>
PILEUS_FN auto to_int(T v) {
    if constexpr (width_of<T> == 1)
        return std::int32_t(v);
    else
        return PILEUS_CONVERT(v, I_of<T>);
}
template <class T>
PILEUS_FN auto to_float(T v) {
    if constexpr (width_of<T> == 1)
        return float(v);
    else
        return PILEUS_CONVERT(v, F_of<T>);
}

template <class Mask, class T>
PILEUS_FN T select(Mask m, T yes, T no) {
    return m ? yes : no;
}
template <class Mask>
PILEUS_FN Mask lnot(Mask m) {
    if constexpr (width_of<Mask> == 1)
        return !m;
    else
        return ~m;
}
template <class T>
PILEUS_FN T min_(T a, T b) {
    return select(a < b, a, b);
}
template <class T>
PILEUS_FN T max_(T a, T b) {
    return select(a > b, a, b);
}
template <class T>
PILEUS_FN T abs_(T a) {
    return reinterpret<T>(reinterpret<U_of<T>>(a) & 0x7fffffffu);
}
/// |a| with the sign of b.
template <class T>
PILEUS_FN T copysign_(T a, T b) {
    return reinterpret<T>((reinterpret<U_of<T>>(a) & 0x7fffffffu) |
                          (reinterpret<U_of<T>>(b) & 0x80000000u));
}
/// Largest whole number <= v as an integer; |v| below 2^31.
template <class T>
PILEUS_FN auto floor_int(T v) {
    const auto i = to_int(v);
    const auto f = to_float(i);
    if constexpr (width_of<T> == 1)
        return f > v ? i - 1 : i;
    else
        return i + (f > v);
}

}  // namespace PILEUS_ISA
}  // namespace pileus

#include "kernels_cpu/core/lanes_verbs.h"
