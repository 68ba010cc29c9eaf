// SPDX-License-Identifier: Apache-2.0
// What every phase function takes and gives.
// in: numbers that its host file fills in -> out: a turn of the light.
// docs/phase.md.
#pragma once
#include "kernels_cpu/core/math.h"

namespace pileus {

struct PhaseTable;

/// Numbers of one phase function; each type says in its own file what it reads of them. Left alone
/// they are Henyey-Greenstein's with g = 0: alike in all directions.
struct PhaseParams {
    std::int32_t type = 0;  ///< a PhaseType (phase.h)
    float g1 = 0, g2 = 0, weight = 1;
    float alpha = 0;
    const PhaseTable* table = nullptr;  ///< belongs to whoever owns the medium
};

inline namespace PILEUS_ISA {

/// Angle between the ways before and after, without the cancellation of 1 - cos near 0.
template <class T>
struct Turn {
    T one_minus_cos, sine;
};

/// Draws that choose one of two lobes: the first with probability `weight`.
template <class T>
struct LobeDraw {
    decltype(T{} < T{}) first;
    T u;  ///< the draw stretched back to (0,1) for the chosen lobe
};

template <class T>
PILEUS_FN LobeDraw<T> choose_lobe(float weight, T u) {
    const auto first = u < weight;
    // The guards keep the interval open.
    const T stretched = select(first, u / max_(all<T>(weight), all<T>(0x1p-24f)),
                               (u - weight) / max_(all<T>(1.0f - weight), all<T>(0x1p-24f)));
    return {first, max_(min_(stretched, all<T>(1.0f - 0x1p-24f)), all<T>(0x1p-24f))};
}

/// Peak of a phase function that is largest straight on or straight back.
template <class Phase>
PILEUS_FN float peak_at_ends(const PhaseParams& p) {
    const float forward = Phase::density(p, 0.0f), backward = Phase::density(p, 2.0f);
    return forward > backward ? forward : backward;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
