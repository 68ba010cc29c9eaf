// SPDX-License-Identifier: Apache-2.0
// Own elementary functions: only + - * / sqrt and bit operations in one fixed order.
// in: lanes of floats -> out: the same bits at every width, compiler and machine.
// Polynomials after Moshier's Cephes (single precision); largest errors stated per function are
// measured over the whole stated domain by tests/bits/math_test.cpp.
#pragma once
#include "kernels_cpu/core/lanes.h"

namespace pileus {
inline namespace PILEUS_ISA {

constexpr float kPi = 3.14159265358979f;
constexpr float kInvFourPi = 0.0795774715459477f;

/// Natural logarithm of a normal positive float. Error <= 1 ulp.
template <class T>
PILEUS_FN T log_(T x) {
    // Split x = m 2^e with m in [sqrt(1/2), sqrt(2)).
    const auto bits = reinterpret<I_of<T>>(x);
    const auto e = (bits - 0x3f3504f3) >> 23;
    const auto e_bits = reinterpret<I_of<T>>(reinterpret<U_of<T>>(e) << 23);
    const T m = reinterpret<T>(bits - e_bits);
    const T ef = to_float(e);
    const T f = m - 1.0f;
    const T f2 = f * f;
    T p = all<T>(7.0376836292e-2f);
    p = p * f - 1.1514610310e-1f;
    p = p * f + 1.1676998740e-1f;
    p = p * f - 1.2420140846e-1f;
    p = p * f + 1.4249322787e-1f;
    p = p * f - 1.6668057665e-1f;
    p = p * f + 2.0000714765e-1f;
    p = p * f - 2.4999993993e-1f;
    p = p * f + 3.3333331174e-1f;
    T r = p * f * f2;
    r = r + ef * -2.12194440e-4f;
    r = r - 0.5f * f2;
    return (f + r) + ef * 0.693359375f;
}

/// Core of exp: e^r - 1 for |r| <= 0.35.
template <class T>
PILEUS_FN T expm1_core(T r) {
    T p = all<T>(1.9875691500e-4f);
    p = p * r + 1.3981999507e-3f;
    p = p * r + 8.3334519073e-3f;
    p = p * r + 4.1665795894e-2f;
    p = p * r + 1.6666665459e-1f;
    p = p * r + 5.0000001201e-1f;
    return p * (r * r) + r;
}

/// e^x. Below -87 exactly 0 (no denormals), above 88 clamped to e^88. Error <= 1 ulp.
template <class T>
PILEUS_FN T exp_(T x) {
    const T c = max_(min_(x, all<T>(88.0f)), all<T>(-87.0f));
    const auto n = floor_int(c * 1.44269504088896341f + 0.5f);
    const T nf = to_float(n);
    const T r = (c - nf * 0.693359375f) - nf * -2.12194440e-4f;
    const T scale = reinterpret<T>((n + 127) << 23);
    return select(x < -87.0f, all<T>(0.0f), (expm1_core(r) + 1.0f) * scale);
}

/// 1 - e^-x for x >= 0 without cancellation. Relative error <= 2^-22.
template <class T>
PILEUS_FN T one_minus_exp(T x) {
    const T small = min_(x, all<T>(0.34f));
    return select(x < 0.34f, T{} - expm1_core(T{} - small), 1.0f - exp_(T{} - x));
}

/// sin and cos of 2 pi u for u in [0, 1]. Absolute error <= 1.2e-7.
template <class T>
struct SinCos {
    T sine, cosine;
};
template <class T>
PILEUS_FN SinCos<T> sincos_turns(T u) {
    // Reduce to |angle| <= pi/4 around the nearest quarter turn; exact in float.
    const auto q = to_int(u * 4.0f + 0.5f);
    const T a = (u - to_float(q) * 0.25f) * 6.28318530717958648f;
    const T a2 = a * a;
    T s = all<T>(-1.9515295891e-4f);
    s = s * a2 + 8.3321608736e-3f;
    s = s * a2 - 1.6666654611e-1f;
    s = s * a2 * a + a;
    T c = all<T>(2.443315711809948e-5f);
    c = c * a2 - 1.388731625493765e-3f;
    c = c * a2 + 4.166664568298827e-2f;
    c = c * a2 * a2 - 0.5f * a2 + 1.0f;
    const auto odd = (q & 1) != 0;
    const auto negative_sine = (q & 2) != 0;
    const auto negative_cosine = ((q + 1) & 2) != 0;
    const T sine = select(odd, c, s), cosine = select(odd, s, c);
    return {select(negative_sine, T{} - sine, sine), select(negative_cosine, T{} - cosine, cosine)};
}

/// Angle of (x, y) from the x axis in turns, in [-1/2, 1/2]; 0 at the origin. For lengths from
/// 1e-15 to 1e15. Absolute error <= 3e-8 turns.
template <class T>
PILEUS_FN T atan2_turns(T y, T x) {
    // Reduce to |angle| <= pi/8 by the diagonals of the octants.
    const T ax = abs_(x), ay = abs_(y);
    const T least = min_(ax, ay), most = max_(max_(ax, ay), all<T>(1e-30f));
    const auto steep = least > most * 0.41421356237309505f;
    const T t = select(steep, least - most, least) / select(steep, least + most, most);
    const T t2 = t * t;
    T p = all<T>(8.05374449538e-2f);
    p = p * t2 - 1.38776856032e-1f;
    p = p * t2 + 1.99777106478e-1f;
    p = p * t2 - 3.33329491539e-1f;
    p = (p * t2 * t + t) * 0.159154943091895336f;
    p = select(steep, p + 0.125f, p);
    p = select(ay > ax, 0.25f - p, p);
    p = select(x < 0.0f, 0.5f - p, p);
    return copysign_(p, y);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
