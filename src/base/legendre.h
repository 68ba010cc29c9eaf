// SPDX-License-Identifier: Apache-2.0
// Legendre polynomials of all degrees at once, and where angles are looked at.
// in: a cosine -> out: P_l of it, l = 0, 1, 2 ...
#pragma once
#include <cstddef>

namespace pileus {

/// Calls use(l, P_l(cosine)) for l = 0 ... degrees - 1, by Bonnet's recurrence.
template <class Use>
void legendre(double cosine, int degrees, const Use& use) {
    double before = 1, current = cosine;
    for (int l = 0; l < degrees; ++l) {
        use(std::size_t(l), before);
        const double n = l;
        const double above = ((2 * n + 3) * cosine * current - (n + 1) * before) / (n + 2);
        before = current;
        current = above;
    }
}

/// 1 - cos of an angle at the share `at` of all, 0 to 1: closest together at both ends.
inline double turn_at_share(double at) {
    const double near = at < 0.5 ? at : 1 - at;
    return at < 0.5 ? 4 * near * near : 2 - 4 * near * near;
}

}  // namespace pileus
