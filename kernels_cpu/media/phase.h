// SPDX-License-Identifier: Apache-2.0
// Phase functions: sample, evaluate, and their Legendre moments.
// in: one uniform in (0,1) or 1-cos(theta) -> out: 1-cos and sin of the turn, or density in 1/sr.
// docs/phase.md: every formula and its source; carries 1-cos(theta), not cos(theta).
#pragma once
#include "kernels_cpu/media/phase_draine.h"
#include "kernels_cpu/media/phase_table.h"

namespace pileus {

enum PhaseType : std::int32_t {
    kPhaseHg = 0,
    kPhaseTwoLobe = 1,
    kPhaseRayleigh = 2,
    kPhaseHgDraine = 3,
    kPhaseTable = 4,
};

/// Isotropic is HG with g = 0. Two-lobe: weight*HG(g1) + (1-weight)*HG(g2). HG and Draine:
/// weight*HG(g1) + (1-weight)*Draine(g2, alpha). A table belongs to whoever owns the medium.
struct PhaseParams {
    std::int32_t type;
    float g1, g2, weight;
    float alpha = 0;
    const PhaseTable* table = nullptr;
};

inline namespace PILEUS_ISA {

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
    if (p.type == kPhaseTable) return table_sample(*p.table, u);
    if (p.type == kPhaseRayleigh) return rayleigh_sample(u);
    if (p.type == kPhaseHg) return hg_sample(all<T>(p.g1), u);
    const auto first = u < p.weight;
    // Stretch the chosen part of (0,1) back to (0,1); the guards keep it open.
    const T stretched = select(first, u / max_(all<T>(p.weight), all<T>(0x1p-24f)),
                               (u - p.weight) / max_(all<T>(1.0f - p.weight), all<T>(0x1p-24f)));
    const T open = max_(min_(stretched, all<T>(1.0f - 0x1p-24f)), all<T>(0x1p-24f));
    if (p.type == kPhaseTwoLobe) return hg_sample(select(first, all<T>(p.g1), all<T>(p.g2)), open);
    const Turn<T> peak = hg_sample(all<T>(p.g1), open);
    const Turn<T> rest = draine_sample(p.g2, p.alpha, open);
    return {select(first, peak.one_minus_cos, rest.one_minus_cos),
            select(first, peak.sine, rest.sine)};
}

template <class T>
PILEUS_FN T phase_density(const PhaseParams& p, T one_minus_cos) {
    if (p.type == kPhaseTable) return table_density(*p.table, one_minus_cos);
    if (p.type == kPhaseRayleigh) {
        const T c = 1.0f - one_minus_cos;
        return 0.75f * kInvFourPi * (1.0f + c * c);
    }
    const T first = hg_density(all<T>(p.g1), one_minus_cos);
    if (p.type == kPhaseHg) return first;
    const T second = p.type == kPhaseHgDraine ? draine_density(p.g2, p.alpha, one_minus_cos)
                                              : hg_density(all<T>(p.g2), one_minus_cos);
    return p.weight * first + (1.0f - p.weight) * second;
}

/// Largest density over all angles, 1/sr; bounds a deposit of the phase function.
PILEUS_FN float phase_peak(const PhaseParams& p) {
    if (p.type == kPhaseTable) return p.table->peak;
    const float forward = phase_density(p, 0.0f), backward = phase_density(p, 2.0f);
    return forward > backward ? forward : backward;
}

/// Legendre moment of degree l, 0 <= l < kPhaseMoments: what scattering multiplies band l of the
/// radiance by.
PILEUS_FN float phase_moment(const PhaseParams& p, int l) {
    if (l == 0) return 1.0f;
    if (p.type == kPhaseTable) return p.table->moment[l];
    if (p.type == kPhaseRayleigh) return l == 2 ? 0.1f : 0.0f;
    const float first = hg_moment(p.g1, l);
    if (p.type == kPhaseHg) return first;
    const float second =
        p.type == kPhaseHgDraine ? draine_moment(p.g2, p.alpha, l) : hg_moment(p.g2, l);
    return p.weight * first + (1.0f - p.weight) * second;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
