// SPDX-License-Identifier: Apache-2.0
// Phase functions: sample, evaluate, and their Legendre moments.
// in: one uniform in (0,1) or 1-cos(theta) -> out: 1-cos and sin of the turn, or density in 1/sr.
// docs/methods.md 2: Henyey-Greenstein without cancellation; carries 1-cos(theta), not cos(theta).
#pragma once
#include "kernels_cpu/math.h"

namespace pileus {

enum PhaseType : std::int32_t { kPhaseHg = 0, kPhaseTwoLobe = 1, kPhaseRayleigh = 2 };

/// Isotropic is HG with g = 0. Two-lobe: weight*HG(g1) + (1-weight)*HG(g2).
struct PhaseParams {
    std::int32_t type;
    float g1, g2, weight;
};

inline namespace PILEUS_ISA {

template <class T>
struct Turn {
    T one_minus_cos, sine;
};

/// HG for any |g| <= 1, u in (0,1); u -> 0 is forward for g > 0. 1-cos in [0, 2], error <= 4.5e-7
/// absolute and relative; sine in [0, 1], error <= 4.5e-7 relative.
template <class T>
PILEUS_FN Turn<T> hg_sample(T g, T u) {
    const T v = 1.0f - u;
    const auto forward = g >= 0.0f;
    const T minus = 1.0f - g, plus = 1.0f + g;
    const T d = select(forward, minus + 2.0f * g * v, plus - 2.0f * g * u);
    const T a = select(forward, 1.0f + g * v, u + v * plus);
    const T b = select(forward, v + u * minus, 1.0f - g * u);
    const T d2 = d * d;
    const T one_minus = 2.0f * (minus * minus) * (u * a) / d2;
    const T one_plus = 2.0f * (plus * plus) * (v * b) / d2;
    // Keep the smaller of the two: its error is the smaller, and |cos| stays <= 1.
    return {select(one_minus < one_plus, one_minus, 2.0f - one_plus),
            min_(sqrt_(one_minus * one_plus), all<T>(1.0f))};
}

/// HG density in 1/sr; 1-cos outside [0, 2] by rounding counts as the nearer end.
/// At |g| = 1 (a delta function) it is 0 everywhere.
template <class T>
PILEUS_FN T hg_density(T g, T one_minus_cos) {
    const T minus = 1.0f - g, plus = 1.0f + g;
    const auto forward = g >= 0.0f;
    // Measure from the peak: squared distance to it, and 1 - cos of the angle to it.
    const T edge = select(forward, minus, plus);
    const T turn = max_(select(forward, one_minus_cos, 2.0f - one_minus_cos), T{});
    const T safe = max_(edge * edge + 2.0f * abs_(g) * turn, all<T>(1e-24f));
    return kInvFourPi * (minus * plus) / (safe * sqrt_(safe));
}

/// Rayleigh: solves c^3 + 3c = 4 - 8u by Newton's method; the slope is >= 3, five steps suffice.
template <class T>
PILEUS_FN Turn<T> rayleigh_sample(T u) {
    const T b = 4.0f - 8.0f * u;
    T c = b * 0.25f;
    for (int i = 0; i < 5; ++i) c = c - (c * c * c + 3.0f * c - b) / (3.0f * c * c + 3.0f);
    c = max_(min_(c, all<T>(1.0f)), all<T>(-1.0f));
    const T one_minus = 1.0f - c;
    return {one_minus, sqrt_(one_minus * (1.0f + c))};
}

template <class T>
PILEUS_FN Turn<T> phase_sample(const PhaseParams& p, T u) {
    if (p.type == kPhaseRayleigh) return rayleigh_sample(u);
    if (p.type == kPhaseHg) return hg_sample(all<T>(p.g1), u);
    const auto first = u < p.weight;
    // Stretch the chosen part of (0,1) back to (0,1); the guards keep it open.
    const T stretched = select(first, u / max_(all<T>(p.weight), all<T>(0x1p-24f)),
                               (u - p.weight) / max_(all<T>(1.0f - p.weight), all<T>(0x1p-24f)));
    const T open = max_(min_(stretched, all<T>(1.0f - 0x1p-24f)), all<T>(0x1p-24f));
    return hg_sample(select(first, all<T>(p.g1), all<T>(p.g2)), open);
}

template <class T>
PILEUS_FN T phase_density(const PhaseParams& p, T one_minus_cos) {
    if (p.type == kPhaseRayleigh) {
        const T c = 1.0f - one_minus_cos;
        return 0.75f * kInvFourPi * (1.0f + c * c);
    }
    const T first = hg_density(all<T>(p.g1), one_minus_cos);
    if (p.type == kPhaseHg) return first;
    return p.weight * first + (1.0f - p.weight) * hg_density(all<T>(p.g2), one_minus_cos);
}

/// Largest density over all angles, 1/sr; bounds a deposit of the phase function.
PILEUS_FN float phase_peak(const PhaseParams& p) {
    const float forward = phase_density(p, 0.0f), backward = phase_density(p, 2.0f);
    return forward > backward ? forward : backward;
}

/// Legendre moment of degree l: what scattering multiplies band l of the radiance by.
PILEUS_FN float phase_moment(const PhaseParams& p, int l) {
    if (l == 0) return 1.0f;
    if (p.type == kPhaseRayleigh) return l == 2 ? 0.1f : 0.0f;
    float a = 1.0f, b = 1.0f;
    for (int i = 0; i < l; ++i) a = a * p.g1, b = b * p.g2;
    return p.type == kPhaseHg ? a : p.weight * a + (1.0f - p.weight) * b;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
