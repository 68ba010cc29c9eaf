// SPDX-License-Identifier: Apache-2.0
// Henyey-Greenstein and Draine: weight*HG(g1) + (1-weight)*Draine(g2, alpha).
// in: g1 in [-1, 1], weight in [0, 1], g2 and alpha of phase_draine.h -> out: turn, density,
// moment. docs/phase.md, "HG and Draine"; Jendersie and d'Eon 2023.
#pragma once
#include "kernels_cpu/media/phase_draine.h"

namespace pileus {
inline namespace PILEUS_ISA {

struct HgDrainePhase {
    template <class T>
    PILEUS_FN Turn<T> sample(const PhaseParams& p, T u) {
        const LobeDraw<T> draw = choose_lobe(p.weight, u);
        const Turn<T> peak = hg_sample(all<T>(p.g1), draw.u);
        const Turn<T> rest = draine_sample(p.g2, p.alpha, draw.u);
        return {select(draw.first, peak.one_minus_cos, rest.one_minus_cos),
                select(draw.first, peak.sine, rest.sine)};
    }

    template <class T>
    PILEUS_FN T density(const PhaseParams& p, T one_minus_cos) {
        const T first = hg_density(all<T>(p.g1), one_minus_cos);
        const T second = draine_density(p.g2, p.alpha, one_minus_cos);
        return p.weight * first + (1.0f - p.weight) * second;
    }

    PILEUS_FN float peak(const PhaseParams& p) { return peak_at_ends<HgDrainePhase>(p); }

    PILEUS_FN float moment(const PhaseParams& p, int l) {
        const float second = draine_moment(p.g2, p.alpha, l);
        return p.weight * hg_moment(p.g1, l) + (1.0f - p.weight) * second;
    }
};

}  // namespace PILEUS_ISA
}  // namespace pileus
