// SPDX-License-Identifier: Apache-2.0
// Rayleigh's phase function of molecules: 3/(16 pi) (1 + cos^2).
// in: one uniform or 1-cos -> out: a turn, density in 1/sr, moments.
// docs/phase.md; Rayleigh 1871.
#pragma once
#include "kernels_cpu/media/phase_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Solves c^3 + 3c = 4 - 8u by Newton's method; the slope is >= 3, five steps suffice.
template <class T>
PILEUS_FN Turn<T> rayleigh_sample(T u) {
    const T b = 4.0f - 8.0f * u;
    T c = b * 0.25f;
    for (int i = 0; i < 5; ++i) c = c - (c * c * c + 3.0f * c - b) / (3.0f * c * c + 3.0f);
    c = max_(min_(c, all<T>(1.0f)), all<T>(-1.0f));
    const T one_minus = 1.0f - c;
    return {one_minus, sqrt_(one_minus * (1.0f + c))};
}

struct RayleighPhase {
    template <class T>
    PILEUS_FN Turn<T> sample(const PhaseParams&, T u) {
        return rayleigh_sample(u);
    }

    template <class T>
    PILEUS_FN T density(const PhaseParams&, T one_minus_cos) {
        const T c = 1.0f - one_minus_cos;
        return 0.75f * kInvFourPi * (1.0f + c * c);
    }

    PILEUS_FN float peak(const PhaseParams& p) { return peak_at_ends<RayleighPhase>(p); }
    PILEUS_FN float moment(const PhaseParams&, int l) { return l == 2 ? 0.1f : 0.0f; }
};

}  // namespace PILEUS_ISA
}  // namespace pileus
