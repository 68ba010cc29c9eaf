// SPDX-License-Identifier: Apache-2.0
// Phase functions in long double: densities, shares of the sphere, samples; slow and plain.
// in: 1 - cos(theta) or a share u counted from the forward direction -> out: reference values.
// docs/phase.md; Henyey, Greenstein 1941; Draine 2003. Negative g is the mirror image of positive
// g.
#pragma once
#include <doctest/doctest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "src/world/phase/phase_table.h"

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

inline Real draine_density_reference(Real g, Real alpha, const Angle& a) {
    const Real c = a.plus - 1, norm = 1 + alpha * (1 + 2 * g * g) / 3;
    return hg_density_reference(g, a) * (1 + alpha * c * c) / norm;
}

/// Light that turns by less: the integral of Draine's function over s = hg_distance.
inline Real draine_share(Real g, Real alpha, const Angle& a) {
    const Real s = hg_distance(g, a), s0 = 1 - g, c = (1 + g * g) / (2 * g);
    const Real k = (1 - g * g) / (2 * g * (1 + alpha * (1 + 2 * g * g) / 3));
    return k * (s - s0) *
           ((1 + alpha * c * c) / (s * s0) - alpha * c / g +
            alpha / (12 * g * g) * (s * s + s * s0 + s0 * s0));
}

/// Where an angle lies in a table: its cell, and the share of the cell's width before it.
struct TablePlace {
    std::size_t cell;
    Real part;
};
inline TablePlace table_place(const PhaseTable& t, const Angle& a) {
    for (std::int32_t i = t.cells - 1;; --i) {
        const bool front = i < t.forward;
        const Real base = Real(t.base[i]), width = Real(t.width[i]);
        const Real part = front ? (a.minus - base) / width : 1 - (a.plus - base) / width;
        if (part >= 0 || i == 0)
            return {std::size_t(i), part < 0 ? Real(0) : part > 1 ? Real(1) : part};
    }
}

inline Real table_density_reference(const PhaseTable& t, const Angle& a) {
    const TablePlace at = table_place(t, a);
    return (1 - at.part) * Real(t.density[at.cell]) + at.part * Real(t.density[at.cell + 1]);
}

/// Adds up every cell before the angle; the light over the sphere is 1 but for rounding.
inline Real table_share(const PhaseTable& t, const Angle& a) {
    const TablePlace at = table_place(t, a);
    Real sum = 0;
    for (std::size_t i = 0; i < at.cell; ++i)
        sum += (Real(t.density[i]) + Real(t.density[i + 1])) * Real(t.width[i]) / 2;
    const Real first = Real(t.density[at.cell]), last = Real(t.density[at.cell + 1]);
    sum += Real(t.width[at.cell]) * at.part * (first + (last - first) * at.part / 2);
    return 2 * kPiReal * sum;
}

inline Real phase_density_reference(const PhaseParams& p, const Angle& a) {
    const Real c = a.plus - 1;
    if (p.type == kPhaseRayleigh) return 3 * (1 + c * c) / (16 * kPiReal);
    if (p.type == kPhaseTable) return table_density_reference(*p.table, a);
    const Real first = hg_density_reference(Real(p.g1), a);
    if (p.type == kPhaseHg) return first;
    const Real second = p.type == kPhaseHgDraine
                            ? draine_density_reference(Real(p.g2), Real(p.alpha), a)
                            : hg_density_reference(Real(p.g2), a);
    return Real(p.weight) * first + (1 - Real(p.weight)) * second;
}

inline Real phase_share(const PhaseParams& p, const Angle& a) {
    const Real x = a.minus;
    if (p.type == kPhaseRayleigh) return x * (6 - 3 * x + x * x) / 8;
    if (p.type == kPhaseTable) return table_share(*p.table, a);
    const Real first = hg_share(Real(p.g1), a);
    if (p.type == kPhaseHg) return first;
    const Real second = p.type == kPhaseHgDraine ? draine_share(Real(p.g2), Real(p.alpha), a)
                                                 : hg_share(Real(p.g2), a);
    return Real(p.weight) * first + (1 - Real(p.weight)) * second;
}

inline PhaseParams henyey_greenstein(float g) { return {kPhaseHg, g, 0.0f, 1.0f}; }
inline PhaseParams two_lobe(float g1, float g2, float weight) {
    return {kPhaseTwoLobe, g1, g2, weight};
}
/// A table of (angle in degrees, value); the store must outlive the parameters.
inline PhaseParams phase_table(const std::vector<std::pair<double, double>>& list,
                               PhaseStore& store) {
    PhaseNodes nodes;
    REQUIRE(nodes.angle_deg.resize(list.size(), "nodes"));
    REQUIRE(nodes.value.resize(list.size(), "nodes"));
    for (std::size_t i = 0; i < list.size(); ++i) {
        nodes.angle_deg[i] = list[i].first;
        nodes.value[i] = list[i].second;
    }
    REQUIRE(make_phase_table("test", nodes, store));
    return store.params();
}
inline PhaseParams rayleigh() { return {kPhaseRayleigh, 0.0f, 0.0f, 1.0f}; }

}  // namespace pileus
