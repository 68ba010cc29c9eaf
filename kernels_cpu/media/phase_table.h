// SPDX-License-Identifier: Apache-2.0
// A phase function given at nodes, linear in the cosine between them: sample and evaluate.
// in: the table's arrays, one uniform or 1-cos -> out: a turn, or density in 1/sr.
// docs/phase.md, "Tables": both use the same function; each cell inverts its quadratic share.
#pragma once
#include "kernels_cpu/media/phase_params.h"

namespace pileus {

/// Moments that a table keeps, degrees 0 ... 15.
constexpr int kPhaseMoments = 16;

/// Arrays of one table. Cells [0, forward) begin before 90 degrees and measure 1 - cos from their
/// first node; the others measure 1 + cos from their last, so that both peaks keep their digits.
struct PhaseTable {
    std::int32_t cells;              ///< >= 1
    std::int32_t forward;            ///< cells that begin before 90 degrees
    std::int32_t slots;              ///< of both guides, a power of two
    std::int32_t draw_steps;         ///< halvings that find a cell by a draw
    std::int32_t find_steps;         ///< halvings that find a cell by 1 - cos
    const float* turn;               ///< [cell + 1] 1 - cos of the nodes, ascending from 0 to 2
    const float* base;               ///< [cell] 1 - cos of its first node, or 1 + cos of its last
    const float* width;              ///< [cell] in the cosine, > 0
    const float* density;            ///< [cell + 1] at the nodes, 1/sr
    const float* share;              ///< [cell + 1] of the light that turns by less, 0 to exactly 1
    const std::int32_t* draw_guide;  ///< [slot + 1] first cell that a draw of the slot may mean
    const std::int32_t* find_guide;  ///< [slot + 1] the same for 1 - cos
    float peak;                      ///< largest density, 1/sr
    float moment[kPhaseMoments];     ///< Legendre moments
};

inline namespace PILEUS_ISA {

/// Slot of a draw in [0, 1).
template <class T>
PILEUS_FN auto draw_slot(std::int32_t slots, T u) {
    return to_int(u * float(slots));
}

/// Place in [0, 1] of 1-cos in [0, 2]: even in angle near both ends, where peaks are; grows with
/// it, whatever the rounding.
template <class T>
PILEUS_FN T even_at_ends(T x) {
    const auto front = x < 1.0f;
    const T root = 0.5f * sqrt_(select(front, x, 2.0f - x));
    return select(front, root, 1.0f - root);
}

/// Slot of 1-cos in [0, 2].
template <class T>
PILEUS_FN auto find_slot(std::int32_t slots, T x) {
    const auto slot = to_int(even_at_ends(x) * float(slots));
    return min_(slot, all<I_of<T>>(slots - 1));
}

/// The last cell in [low, high] whose key is not above `value`; the key of `low` is not.
template <class T>
PILEUS_FN auto last_not_above(const float* key, I_of<T> low, I_of<T> high, int steps, T value) {
    for (int i = 0; i < steps; ++i) {
        const I_of<T> middle = (low + high + 1) >> 1;
        const auto reached = gather(key, middle) <= value;
        low = select(reached, middle, low);
        high = select(reached, high, middle - 1);
    }
    return low;
}

/// u in (0,1), u -> 0 is forward. Cells without light are never drawn.
template <class T>
PILEUS_FN Turn<T> table_sample(const PhaseTable& t, T u) {
    using II = I_of<T>;
    const II slot = draw_slot(t.slots, u);
    const II cell = last_not_above(t.share, gather(t.draw_guide, slot),
                                   gather(t.draw_guide, slot + 1), t.draw_steps, u);
    const T below = gather(t.share, cell), above = gather(t.share, cell + 1);
    const T r = max_(min_((u - below) / (above - below), all<T>(1.0f)), T{});
    // Solve a f + (b - a) f^2 / 2 = r (a + b) / 2 for the place f in the cell.
    const T a = gather(t.density, cell), b = gather(t.density, cell + 1);
    const T root = sqrt_((1.0f - r) * (a * a) + r * (b * b));
    const T f = min_(r * (a + b) / max_(a + root, all<T>(1e-30f)), all<T>(1.0f));

    const auto front = cell < t.forward;
    const T length = gather(t.width, cell) * select(front, f, 1.0f - f);
    const T near = gather(t.base, cell) + length, far = 2.0f - near;
    return {select(front, near, far), min_(sqrt_(max_(near * far, T{})), all<T>(1.0f))};
}

/// Density in 1/sr; 1-cos outside [0, 2] by rounding counts as the nearer end.
template <class T>
PILEUS_FN T table_density(const PhaseTable& t, T one_minus_cos) {
    using II = I_of<T>;
    const T x = max_(min_(one_minus_cos, all<T>(2.0f)), T{});
    const II slot = find_slot(t.slots, x);
    const II cell = last_not_above(t.turn, gather(t.find_guide, slot),
                                   gather(t.find_guide, slot + 1), t.find_steps, x);
    const auto front = cell < t.forward;
    const T part = (select(front, x, 2.0f - x) - gather(t.base, cell)) / gather(t.width, cell);
    const T f = max_(min_(select(front, part, 1.0f - part), all<T>(1.0f)), T{});
    const T a = gather(t.density, cell), b = gather(t.density, cell + 1);
    // Rounding must not lead above both ends: the peak bounds sums.
    return min_((1.0f - f) * a + f * b, max_(a, b));
}

struct TablePhase {
    template <class T>
    PILEUS_FN Turn<T> sample(const PhaseParams& p, T u) {
        return table_sample(*p.table, u);
    }

    template <class T>
    PILEUS_FN T density(const PhaseParams& p, T one_minus_cos) {
        return table_density(*p.table, one_minus_cos);
    }

    PILEUS_FN float peak(const PhaseParams& p) { return p.table->peak; }
    PILEUS_FN float moment(const PhaseParams& p, int l) { return p.table->moment[l]; }
};

}  // namespace PILEUS_ISA
}  // namespace pileus
