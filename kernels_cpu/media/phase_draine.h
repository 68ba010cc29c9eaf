// SPDX-License-Identifier: Apache-2.0
// Draine's phase function: sample, evaluate, and its Legendre moments.
// in: g in (0.3, 0.7), at alpha 1 in [0.2, 0.99], one uniform or 1-cos -> out: turn, density 1/sr.
// docs/phase.md; Draine 2003, Jendersie and d'Eon 2023: HG(g) times (1 + alpha cos^2), normalised.
#pragma once
#include "kernels_cpu/media/phase_hg.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// 1 + alpha times the mean of cos^2 over HG(g).
PILEUS_FN float draine_norm(float g, float alpha) {
    return 1.0f + alpha * (1.0f + 2.0f * g * g) * (1.0f / 3.0f);
}

template <class T>
PILEUS_FN T draine_density(float g, float alpha, T one_minus_cos) {
    const T c = 1.0f - one_minus_cos;
    return hg_density(all<T>(g), one_minus_cos) * (1.0f + alpha * c * c) / draine_norm(g, alpha);
}

/// Distance s = sqrt(1 + g^2 - 2 g cos) that a share u of the light stays within: root of a quartic
/// (Jendersie and d'Eon 2023, in shorter form). Good to a few 1e-4 in floats.
template <class T>
PILEUS_FN T draine_quartic(float g, float alpha, T u) {
    const float g2 = g * g, one = 1.0f - g2, half = 1.0f + g2, q = alpha * one;
    const T side = 1.0f - 2.0f * u;
    const T a =
        3.0f * g2 * (1.0f + g * side) + alpha * (2.0f + g2 + g * g2 * (1.0f + 2.0f * g2) * side);
    const T b = a * a - 4.0f * q * half * (q * half * half + 3.0f * g2 * one);
    const float c = 64.0f * alpha * (g2 * one) * (g2 * one) * (g2 * one) * one;
    const T root = sqrt_(b * b + c);
    // b + root, without cancellation where b is negative.
    const T sum = select(b < 0.0f, c / (root - b), b + root);
    const T w = exp_(log_(q * sum) * (1.0f / 3.0f));
    const T d = max_(4.0f * half + 2.0f * w / q - 8.0f * g2 * one / w, all<T>(1e-6f));
    const T e = sqrt_(d);
    return 0.5f * (sqrt_(max_(12.0f * half - d + 8.0f * a / (q * e), T{})) - e);
}

/// u in (0,1), u -> 0 is forward. 1-cos in [0, 2]; for 5 to 50 um the light turned by
/// less is u within 8e-7.
template <class T>
PILEUS_FN Turn<T> draine_sample(float g, float alpha, T u) {
    const float minus = 1.0f - g, plus = 1.0f + g, c = (1.0f + g * g) / (2.0f * g);
    const float k = minus * plus / (2.0f * g * draine_norm(g, alpha));
    const float a = 1.0f + alpha * c * c, b = alpha * c / g, d = alpha / (12.0f * g * g);
    T s = draine_quartic(g, alpha, u);
    s = max_(min_(s, all<T>(plus)), all<T>(minus));
    // One step of Newton's method on the share itself, which is a polynomial over s.
    const T share = k * (s - minus) * (a / (minus * s) - b + d * (s * s + minus * (s + minus)));
    const T cosine = c - s * s * (0.5f / g);
    s = s - (share - u) * (s * s) / (k * (1.0f + alpha * cosine * cosine));
    const T one_minus = max_((s - minus) * (s + minus) * (0.5f / g), T{});
    const T one_plus = max_((plus - s) * (plus + s) * (0.5f / g), T{});
    return {select(one_minus < one_plus, one_minus, 2.0f - one_plus),
            min_(sqrt_(one_minus * one_plus), all<T>(1.0f))};
}

/// Legendre moment of degree l >= 1, by twice the recurrence of cos times P_l.
PILEUS_FN float draine_moment(float g, float alpha, int l) {
    const float n = float(l), power = hg_moment(g, l);
    const float up = (n + 1.0f) * (n + 2.0f) / ((2.0f * n + 1.0f) * (2.0f * n + 3.0f));
    const float same = (n + 1.0f) * (n + 1.0f) / ((2.0f * n + 1.0f) * (2.0f * n + 3.0f)) +
                       n * n / ((2.0f * n + 1.0f) * (2.0f * n - 1.0f));
    const float down = n * (n - 1.0f) / ((2.0f * n + 1.0f) * (2.0f * n - 1.0f));
    float sum = up * power * g * g + same * power;
    if (l >= 2) sum = sum + down * hg_moment(g, l - 2);
    return (power + alpha * sum) / draine_norm(g, alpha);
}

}  // namespace PILEUS_ISA
}  // namespace pileus
