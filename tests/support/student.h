// SPDX-License-Identifier: Apache-2.0
// The half width of the 95 % interval of a mean, in standard errors.
// in: degrees of freedom of the standard error -> out: the 97.5 % quantile of Student's t.
// Abramowitz & Stegun 26.7.3, 26.7.4 and 26.5: the law in closed form; inverted by bisection.
#pragma once
#include <cmath>

namespace student {

/// P(|t| <= x) for `n` degrees of freedom, n >= 1.
inline double inside(double x, int n) {
    const double angle = std::atan(x / std::sqrt(double(n)));
    const double c = std::cos(angle), s = std::sin(angle), pi = std::acos(-1.0);
    // Sum 1 + (a)c^2 + (a)(b)c^4 + ..., from the innermost bracket.
    double sum = 0;
    if (n % 2 == 0) {
        for (int k = n - 2; k >= 2; k -= 2) sum = (1 + sum) * c * c * (k - 1) / k;
        return s * (1 + sum);
    }
    if (n == 1) return 2 * angle / pi;
    for (int k = n - 2; k >= 3; k -= 2) sum = (1 + sum) * c * c * (k - 1) / k;
    return 2 / pi * (angle + s * c * (1 + sum));
}

inline double quantile_95(int n) {
    double low = 1.9, high = 13;
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        (inside(middle, n) < 0.95 ? low : high) = middle;
    }
    return low;
}

}  // namespace student
