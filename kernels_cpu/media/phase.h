// SPDX-License-Identifier: Apache-2.0
// Phase functions: sample, evaluate, and their Legendre moments. The list of the kernels' types.
// in: one uniform in (0,1) or 1-cos(theta) -> out: 1-cos and sin of the turn, or density in 1/sr.
// docs/phase.md: every formula and its source; carries 1-cos(theta), not cos(theta).
#pragma once
#include "kernels_cpu/media/phase_hg.h"
#include "kernels_cpu/media/phase_hg_draine.h"
#include "kernels_cpu/media/phase_rayleigh.h"
#include "kernels_cpu/media/phase_table.h"
#include "kernels_cpu/media/phase_two_lobe.h"

namespace pileus {

// One row for a type: kPhaseHg is computed by HgPhase, and so on. Nothing else here names a type.
#define PILEUS_PHASES(ROW) \
    ROW(Hg)                \
    ROW(TwoLobe)           \
    ROW(Rayleigh)          \
    ROW(HgDraine)          \
    ROW(Table)

enum PhaseType : std::int32_t {
#define PILEUS_ROW(Name) kPhase##Name,
    PILEUS_PHASES(PILEUS_ROW)
#undef PILEUS_ROW
        kPhaseTypes
};
static_assert(kPhaseHg == 0, "parameters left alone scatter alike in all directions");

inline namespace PILEUS_ISA {

/// u in (0,1), u -> 0 is forward.
template <class T>
PILEUS_FN Turn<T> phase_sample(const PhaseParams& p, T u) {
#define PILEUS_ROW(Name) \
    if (p.type == kPhase##Name) return Name##Phase::sample(p, u);
    PILEUS_PHASES(PILEUS_ROW)
#undef PILEUS_ROW
    return {T{}, T{}};
}

template <class T>
PILEUS_FN T phase_density(const PhaseParams& p, T one_minus_cos) {
#define PILEUS_ROW(Name) \
    if (p.type == kPhase##Name) return Name##Phase::density(p, one_minus_cos);
    PILEUS_PHASES(PILEUS_ROW)
#undef PILEUS_ROW
    return T{};
}

/// Largest density over all angles, 1/sr; bounds a deposit of the phase function.
PILEUS_FN float phase_peak(const PhaseParams& p) {
#define PILEUS_ROW(Name) \
    if (p.type == kPhase##Name) return Name##Phase::peak(p);
    PILEUS_PHASES(PILEUS_ROW)
#undef PILEUS_ROW
    return 0;
}

/// Legendre moment of degree l, 0 <= l < kPhaseMoments: what scattering multiplies band l of the
/// radiance by.
PILEUS_FN float phase_moment(const PhaseParams& p, int l) {
    if (l == 0) return 1.0f;
#define PILEUS_ROW(Name) \
    if (p.type == kPhase##Name) return Name##Phase::moment(p, l);
    PILEUS_PHASES(PILEUS_ROW)
#undef PILEUS_ROW
    return 0;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
