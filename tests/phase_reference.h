// SPDX-License-Identifier: Apache-2.0
// Phase functions in long double: densities, shares of the sphere, samples; slow and plain.
// in: 1 - cos(theta) or a share u counted from the forward direction -> out: reference values.
// docs/methods.md 2; Henyey, Greenstein 1941. Negative g is the mirror image of positive g.
#pragma once
#include <cmath>

#include "kernels_cpu/phase.h"

namespace pileus {

using Real = long double;
constexpr Real kPiReal = 3.14159265358979323846264338327950288L;

/// 1 - cos and 1 + cos, both with full relative precision.
struct Angle {
    Real minus, plus;
};
inline Angle from_minus(Real x) { return {x, 2 - x}; }
inline Angle from_plus(Real y) { return {2 - y, y}; }
inline Angle mirrored(const Angle& a) { return {a.plus, a.minus}; }

/// sqrt(1 + g^2 - 2 g cos) without cancellation, 0 <= g < 1.
inline Real hg_distance(Real g, const Angle& a) {
    return std::sqrt((1 - g) * (1 - g) + 2 * g * a.minus);
}

/// Density in 1/sr for |g| < 1.
inline Real hg_density_reference(Real g, const Angle& a) {
    if (g < 0) return hg_density_reference(-g, mirrored(a));
    const Real q = hg_distance(g, a);
    return (1 - g) * (1 + g) / (4 * kPiReal * q * q * q);
}

/// Share of the light that turns by less than the angle, |g| < 1.
inline Real hg_share(Real g, const Angle& a) {
    if (g < 0) return 1 - hg_share(-g, mirrored(a));
    const Real q = hg_distance(g, a);
    return (1 + g) * a.minus / (q * (q + (1 - g)));
}

/// The angle that a share u of the light does not exceed: docs/methods.md 2, |g| < 1.
inline Angle hg_angle(Real g, Real u) {
    if (g < 0) return mirrored(hg_angle(-g, 1 - u));
    const Real v = 1 - u, d = (1 - g) + 2 * g * v;
    return {2 * (1 - g) * (1 - g) * u * (1 + g * v) / (d * d),
            2 * (1 + g) * (1 + g) * v * (v + u * (1 - g)) / (d * d)};
}

/// cos of the same angle by the formula of the textbooks, which cancels for small g.
inline Real hg_cosine_textbook(Real g, Real u) {
    const Real s = (1 - g * g) / (1 - g + 2 * g * (1 - u));
    return (1 + g * g - s * s) / (2 * g);
}

inline Real phase_density_reference(const PhaseParams& p, const Angle& a) {
    const Real c = a.plus - 1;
    if (p.type == kPhaseRayleigh) return 3 * (1 + c * c) / (16 * kPiReal);
    const Real first = hg_density_reference(Real(p.g1), a);
    if (p.type == kPhaseHg) return first;
    return Real(p.weight) * first + (1 - Real(p.weight)) * hg_density_reference(Real(p.g2), a);
}

inline Real phase_share(const PhaseParams& p, const Angle& a) {
    const Real x = a.minus;
    if (p.type == kPhaseRayleigh) return x * (6 - 3 * x + x * x) / 8;
    const Real first = hg_share(Real(p.g1), a);
    if (p.type == kPhaseHg) return first;
    return Real(p.weight) * first + (1 - Real(p.weight)) * hg_share(Real(p.g2), a);
}

inline PhaseParams henyey_greenstein(float g) { return {kPhaseHg, g, 0.0f, 1.0f}; }
inline PhaseParams two_lobe(float g1, float g2, float weight) {
    return {kPhaseTwoLobe, g1, g2, weight};
}
inline PhaseParams rayleigh() { return {kPhaseRayleigh, 0.0f, 0.0f, 1.0f}; }

}  // namespace pileus
