// SPDX-License-Identifier: Apache-2.0
// Reflection and transmission of a plane-parallel slab by adding and doubling, in double.
// in: optical depth, albedo, g, directions of the incoming light -> out: fluxes, or the operators.
// docs/validation.md; van de Hulst 1963; diamond initialisation and delta-M: Wiscombe 1976, 1977.
// Shares nothing with the renderer, so that a common mistake can't hide.
#pragma once
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace adding_doubling {

using Matrix = std::vector<double>;  // n x n, row-major

struct Slab {
    double tau, albedo, g;
};

/// Shares of the flux that arrives; `transmitted` includes `direct`.
struct Fluxes {
    double reflected, transmitted, direct;
};

/// What a slab does to intensities at its directions: row = direction of leaving, column = of
/// arriving. The first `streams` directions carry flux, those after them only listen.
struct Operators {
    int streams = 0;
    std::vector<double> mu, weight;
    Matrix reflect, transmit;
};

/// Gauss-Legendre nodes and weights on (0, 1).
inline void gauss(int n, std::vector<double>& x, std::vector<double>& w) {
    const double pi = std::acos(-1.0);
    x.resize(std::size_t(n));
    w.resize(std::size_t(n));
    for (int i = 0; i < n; ++i) {
        double z = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 100; ++step) {
            double p = 1, before = 0;
            for (int k = 0; k < n; ++k) {
                const double next = ((2 * k + 1) * z * p - k * before) / (k + 1);
                before = p;
                p = next;
            }
            slope = n * (z * p - before) / (z * z - 1);
            const double change = p / slope;
            z -= change;
            if (std::fabs(change) < 1e-16) break;
        }
        x[std::size_t(n - 1 - i)] = 0.5 * (1 + z);
        w[std::size_t(n - 1 - i)] = 1 / ((1 - z * z) * slope * slope);
    }
}

inline Matrix product(const Matrix& a, const Matrix& b, std::size_t n) {
    Matrix c(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k) {
            const double f = a[i * n + k];
            if (f == 0) continue;
            for (std::size_t j = 0; j < n; ++j) c[i * n + j] += f * b[k * n + j];
        }
    return c;
}

/// x in a x = b, by elimination with row pivots; a and b are used up.
inline Matrix solved(Matrix a, Matrix b, std::size_t n) {
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t best = c;
        for (std::size_t r = c + 1; r < n; ++r)
            if (std::fabs(a[r * n + c]) > std::fabs(a[best * n + c])) best = r;
        for (std::size_t j = 0; j < n; ++j) {
            std::swap(a[c * n + j], a[best * n + j]);
            std::swap(b[c * n + j], b[best * n + j]);
        }
        for (std::size_t r = c + 1; r < n; ++r) {
            const double f = a[r * n + c] / a[c * n + c];
            if (f == 0) continue;
            for (std::size_t j = c; j < n; ++j) a[r * n + j] -= f * a[c * n + j];
            for (std::size_t j = 0; j < n; ++j) b[r * n + j] -= f * b[c * n + j];
        }
    }
    for (std::size_t i = n; i-- > 0;)
        for (std::size_t j = 0; j < n; ++j) {
            double sum = b[i * n + j];
            for (std::size_t k = i + 1; k < n; ++k) sum -= a[i * n + k] * b[k * n + j];
            b[i * n + j] = sum / a[i * n + i];
        }
    return b;
}

inline void add_to_diagonal(Matrix& m, std::size_t n, double value) {
    for (std::size_t i = 0; i < n; ++i) m[i * n + i] += value;
}

/// The azimuthal mean of the phase function between directions of `mu`, onward and turned back,
/// by Legendre series; the share `cut` of the light goes straight on and is left out.
inline void phase_matrices(double g, double cut, int terms, const std::vector<double>& mu,
                           Matrix& onward, Matrix& back) {
    const std::size_t n = mu.size();
    std::vector<double> p(n, 1.0), before(n, 0.0);
    onward.assign(n * n, 0.0);
    back.assign(n * n, 0.0);
    for (int l = 0; l < terms; ++l) {
        const double moment = (2 * l + 1) * (std::pow(g, l) - cut) / (1 - cut);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                const double term = moment * p[i] * p[j];
                onward[i * n + j] += term;
                back[i * n + j] += l % 2 == 0 ? term : -term;
            }
        for (std::size_t i = 0; i < n; ++i) {
            const double next = ((2 * l + 1) * mu[i] * p[i] - l * before[i]) / (l + 1);
            before[i] = p[i];
            p[i] = next;
        }
    }
}

/// One thin layer by the diamond scheme (the field inside is the mean of both ends): with
/// L what is lost to other directions and G what is turned round,
/// (1 + L/2) t = (1 - L/2) a + (G/2) r and (1 + L/2) r = (G/2) (a + t) for light a from above.
inline void thin_layer(double tau, double albedo, const Matrix& onward, const Matrix& back,
                       Operators& o) {
    const std::size_t n = o.mu.size();
    Matrix plus(n * n, 0.0), minus(n * n, 0.0), turned(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const double c = 0.25 * tau * albedo * o.weight[j] / o.mu[i];
            const double one = i == j ? 1.0 : 0.0;
            const double half = one * 0.5 * tau / o.mu[i] - c * onward[i * n + j];
            plus[i * n + j] = one + half;
            minus[i * n + j] = one - half;
            turned[i * n + j] = c * back[i * n + j];
        }
    const Matrix m = solved(plus, turned, n), straight = solved(plus, minus, n);
    const Matrix mm = product(m, m, n);
    Matrix a(n * n), b(n * n);
    for (std::size_t i = 0; i < n * n; ++i) {
        a[i] = -mm[i];
        b[i] = straight[i] + mm[i];
    }
    add_to_diagonal(a, n, 1);
    o.transmit = solved(a, b, n);
    Matrix with_one = o.transmit;
    add_to_diagonal(with_one, n, 1);
    o.reflect = product(m, with_one, n);
}

/// Put the layer on top of its like: light goes to and fro between the two.
inline void double_layer(Operators& o) {
    const std::size_t n = o.mu.size();
    Matrix between = product(o.reflect, o.reflect, n);
    for (double& x : between) x = -x;
    add_to_diagonal(between, n, 1);
    const Matrix down = solved(between, o.transmit, n);
    const Matrix up = product(o.transmit, product(o.reflect, down, n), n);
    for (std::size_t i = 0; i < n * n; ++i) o.reflect[i] += up[i];
    o.transmit = product(o.transmit, down, n);
}

/// `streams` Gauss directions a hemisphere, and the cosines `mu0` in (0, 1] besides.
inline Operators operators(const Slab& slab, const std::vector<double>& mu0, int streams) {
    Operators o;
    o.streams = streams;
    gauss(streams, o.mu, o.weight);
    for (double m : mu0) {
        o.mu.push_back(m);
        o.weight.push_back(0.0);
    }
    // Delta-M: the part of the phase function that the streams can't resolve goes straight on.
    const int terms = 2 * streams;
    const double cut = std::pow(slab.g, terms);
    const double albedo = slab.albedo * (1 - cut) / (1 - slab.albedo * cut);
    double thin = slab.tau * (1 - slab.albedo * cut);
    Matrix onward, back;
    phase_matrices(slab.g, cut, terms, o.mu, onward, back);

    int doublings = 0;
    while (thin > 0x1p-20) thin *= 0.5, ++doublings;
    thin_layer(thin, albedo, onward, back, o);
    for (int d = 0; d < doublings; ++d) double_layer(o);
    return o;
}

/// The flux of each incoming direction in `mu0` (cosines in (0, 1]) on a slab over black.
/// 64 streams give about 1e-7 for |g| <= 0.95. By reciprocity the flux that a beam from mu0 sends
/// back is the intensity that leaves towards mu0 under uniform light.
inline std::vector<Fluxes> solve(const Slab& slab, const std::vector<double>& mu0, int streams) {
    const Operators o = operators(slab, mu0, streams);
    const std::size_t n = o.mu.size();
    std::vector<Fluxes> out;
    for (std::size_t k = 0; k < mu0.size(); ++k) {
        const std::size_t i = std::size_t(streams) + k;
        Fluxes f{0, o.transmit[i * n + i], std::exp(-slab.tau / mu0[k])};
        for (std::size_t j = 0; j < std::size_t(streams); ++j) {
            f.reflected += o.reflect[i * n + j];
            f.transmitted += o.transmit[i * n + j];
        }
        out.push_back(f);
    }
    return out;
}

}  // namespace adding_doubling
