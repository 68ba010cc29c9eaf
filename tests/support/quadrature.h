// SPDX-License-Identifier: Apache-2.0
// Gauss-Legendre quadrature in double, plain and graded towards both ends of an interval.
// in: a function on [a, b] -> out: its integral.
// Nodes by Newton's method on the Legendre recurrence: Abramowitz, Stegun 25.4.29.
#pragma once
#include <cmath>
#include <vector>

namespace pileus {

struct Quadrature {
    std::vector<double> node, weight;  // on [-1, 1]
};

inline Quadrature gauss_legendre(int n) {
    Quadrature q;
    for (int i = 0; i < n; ++i) {
        double x = std::cos(3.14159265358979324 * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 20; ++step) {
            double p = 1, previous = 0;
            for (int k = 1; k <= n; ++k) {
                const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
                previous = p;
                p = next;
            }
            slope = n * (x * p - previous) / (x * x - 1);
            x -= p / slope;
        }
        q.node.push_back(x);
        q.weight.push_back(2 / ((1 - x * x) * slope * slope));
    }
    return q;
}

/// Legendre polynomial of degree l at x.
inline double legendre(int l, double x) {
    double p = 1, previous = 0;
    for (int k = 1; k <= l; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
        previous = p;
        p = next;
    }
    return p;
}

template <class Function>
double integrate(const Quadrature& q, double a, double b, Function f) {
    double sum = 0;
    for (std::size_t i = 0; i < q.node.size(); ++i)
        sum += q.weight[i] * f(0.5 * (a + b) + 0.5 * (b - a) * q.node[i]);
    return 0.5 * (b - a) * sum;
}

/// Panels that halve towards both ends, `levels` times: resolves a peak of width 2^-levels there.
template <class Function>
double integrate_graded(const Quadrature& q, double a, double b, int levels, Function f) {
    const double half = 0.5 * (b - a);
    double sum = 0, outer = 1;
    for (int k = 0; k < levels; ++k) {
        const double inner = k + 1 < levels ? 0.5 * outer : 0.0;
        sum += integrate(q, a + half * inner, a + half * outer, f);
        sum += integrate(q, b - half * outer, b - half * inner, f);
        outer = inner;
    }
    return sum;
}

}  // namespace pileus
