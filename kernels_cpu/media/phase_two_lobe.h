// SPDX-License-Identifier: Apache-2.0
// Two lobes of Henyey-Greenstein: weight*HG(g1) + (1-weight)*HG(g2).
// in: g1, g2 in [-1, 1], weight in [0, 1] -> out: a turn, density in 1/sr, moments.
// docs/phase.md.
#pragma once
#include "kernels_cpu/media/phase_hg.h"

namespace pileus {
inline namespace PILEUS_ISA {

struct TwoLobePhase {
    template <class T>
    PILEUS_FN Turn<T> sample(const PhaseParams& p, T u) {
        const LobeDraw<T> draw = choose_lobe(p.weight, u);
        return hg_sample(select(draw.first, all<T>(p.g1), all<T>(p.g2)), draw.u);
    }

    template <class T>
    PILEUS_FN T density(const PhaseParams& p, T one_minus_cos) {
        const T first = hg_density(all<T>(p.g1), one_minus_cos);
        const T second = hg_density(all<T>(p.g2), one_minus_cos);
        return p.weight * first + (1.0f - p.weight) * second;
    }

    PILEUS_FN float peak(const PhaseParams& p) { return peak_at_ends<TwoLobePhase>(p); }

    PILEUS_FN float moment(const PhaseParams& p, int l) {
        return p.weight * hg_moment(p.g1, l) + (1.0f - p.weight) * hg_moment(p.g2, l);
    }
};

}  // namespace PILEUS_ISA
}  // namespace pileus
