// SPDX-License-Identifier: Apache-2.0
// Layers that scatter isotropically, by the integral equation of their source function, in double.
// in: layers, a beam or a uniform sky -> out: fluxes, radiances and mean radiance at any depth.
// docs/validation.md; Schwarzschild-Milne: J(t) = J0(t) + 1/2 integral of E1|t - u| albedo J(u) du.
// Shares nothing with the renderer, nor with tests/theory/adding_doubling.h.
#pragma once
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace isotropic {

struct Layer {
    double tau, albedo;
};

/// Light from above: a beam of flux `beam` on a plane that faces it, a sky of radiance `sky`.
struct Light {
    double beam, mu0, sky;
};

/// Exponential integrals E1, E2, E3 for x >= 0 (x > 0 for E1); series below 1, continued fraction
/// above (Abramowitz & Stegun 5.1.11, 5.1.22, 5.1.14).
inline double e1(double x) {
    if (x < 1) {
        double sum = -0.57721566490153286 - std::log(x), term = 1;
        for (int k = 1; k < 25; ++k) {
            term *= -x / k;
            sum -= term / k;
        }
        return sum;
    }
    double f = 0;
    for (int k = 80; k >= 1; --k) f = k / (1 + k / (x + f));
    return std::exp(-x) / (x + f);
}
inline double e2(double x) { return x <= 0 ? 1 : std::exp(-x) - x * e1(x); }
inline double e3(double x) { return 0.5 * (std::exp(-x) - x * e2(x)); }

/// x of a x = b by elimination; a (row-major) is diagonally heavy and used up.
inline std::vector<double> solved(std::vector<double> a, std::vector<double> b) {
    const std::size_t n = b.size();
    for (std::size_t c = 0; c < n; ++c)
        for (std::size_t r = c + 1; r < n; ++r) {
            const double f = a[r * n + c] / a[c * n + c];
            for (std::size_t j = c; j < n; ++j) a[r * n + j] -= f * a[c * n + j];
            b[r] -= f * b[c];
        }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t j = i + 1; j < n; ++j) b[i] -= a[i * n + j] * b[j];
        b[i] /= a[i * n + i];
    }
    return b;
}

/// The solution: a source that is constant in cells, which are finest at the borders of layers.
/// 300 cells leave 1e-5 in layers up to optical depth 1; thick ones under a low sun need far more.
class Field {
public:
    /// `cells` in each layer; the error falls with their square.
    Field(const std::vector<Layer>& layers, const Light& light, int cells) : light_(light) {
        const double pi = std::acos(-1.0);
        edge_.push_back(0);
        std::vector<double> albedo;
        for (const Layer& layer : layers) {
            const double top = edge_.back();
            for (int i = 1; i <= cells; ++i) {
                edge_.push_back(top + layer.tau * 0.5 * (1 - std::cos(pi * i / cells)));
                albedo.push_back(layer.albedo);
            }
        }
        const std::size_t n = albedo.size();
        std::vector<double> a(n * n), b(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double t = 0.5 * (edge_[i] + edge_[i + 1]);
            b[i] = unscattered(t);
            for (std::size_t j = 0; j < n; ++j)
                a[i * n + j] = (i == j ? 1.0 : 0.0) - 0.5 * albedo[j] * reach(t, j);
        }
        source_ = solved(std::move(a), std::move(b));
        for (std::size_t i = 0; i < n; ++i) source_[i] *= albedo[i];
    }

    /// Radiance averaged over all directions, with the beam's.
    double mean_radiance(double t) const {
        double sum = unscattered(t);
        for (std::size_t j = 0; j < source_.size(); ++j) sum += 0.5 * source_[j] * reach(t, j);
        return sum;
    }

    /// Flux through a level plane, upward or (without the beam) downward.
    double flux(double t, bool up) const {
        const double two_pi = 2 * std::acos(-1.0);
        double sum = up ? 0 : two_pi * light_.sky * e3(t);
        for_cells(t, up, [&](double s, double near, double far) {
            sum += two_pi * s * (e3(near) - e3(far));
        });
        return sum;
    }

    /// Radiance travelling up (mu > 0) or down, without the beam.
    double radiance(double t, double mu) const {
        const double m = std::fabs(mu);
        double sum = mu > 0 ? 0 : light_.sky * std::exp(-t / m);
        for_cells(t, mu > 0, [&](double s, double near, double far) {
            sum += s * (std::exp(-near / m) - std::exp(-far / m));
        });
        return sum;
    }

private:
    double unscattered(double t) const {
        const double beam =
            light_.beam > 0 ? light_.beam * std::exp(-t / light_.mu0) / (4 * std::acos(-1.0)) : 0;
        return beam + 0.5 * light_.sky * e2(t);
    }

    /// Integral of E1|t - u| over cell `j`.
    double reach(double t, std::size_t j) const {
        const double low = t - edge_[j], high = edge_[j + 1] - t;
        if (low > 0 && high > 0) return 2 - e2(low) - e2(high);
        return std::fabs(e2(std::fabs(low)) - e2(std::fabs(high)));
    }

    /// use(source, near, far): the cells below (`up`) or above `t`, by their distances from it.
    template <class Use>
    void for_cells(double t, bool up, Use use) const {
        for (std::size_t j = 0; j < source_.size(); ++j) {
            const double a = up ? edge_[j] - t : t - edge_[j + 1];
            const double b = up ? edge_[j + 1] - t : t - edge_[j];
            if (b > 0) use(source_[j], std::fmax(a, 0), b);
        }
    }

    Light light_;
    std::vector<double> edge_, source_;
};

}  // namespace isotropic
