// SPDX-License-Identifier: Apache-2.0
// Henyey-Greenstein: sample, evaluate, and its Legendre moments.
// in: one uniform in (0,1) or 1-cos(theta) -> out: 1-cos and sin of the turn, or density in 1/sr.
// docs/phase.md: without cancellation for any g; carries 1-cos(theta), not cos(theta).
#pragma once
#include "kernels_cpu/media/phase_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

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

/// g to the power of l.
PILEUS_FN float hg_moment(float g, int l) {
    float power = 1.0f;
    for (int i = 0; i < l; ++i) power = power * g;
    return power;
}

/// Reads g1, the mean cosine.
struct HgPhase {
    template <class T>
    PILEUS_FN Turn<T> sample(const PhaseParams& p, T u) {
        return hg_sample(all<T>(p.g1), u);
    }

    template <class T>
    PILEUS_FN T density(const PhaseParams& p, T one_minus_cos) {
        return hg_density(all<T>(p.g1), one_minus_cos);
    }

    PILEUS_FN float peak(const PhaseParams& p) { return peak_at_ends<HgPhase>(p); }
    PILEUS_FN float moment(const PhaseParams& p, int l) { return hg_moment(p.g1, l); }
};

}  // namespace PILEUS_ISA
}  // namespace pileus
