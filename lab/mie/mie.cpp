// SPDX-License-Identifier: Apache-2.0
// See mie.h. No libm, so that every machine makes the same tables.
// in: spheres -> out: scattering coefficients a_n, b_n, amplitudes S1, S2, and their sums.
// docs/phase.md, "Mie"; Bohren and Huffman 1983, 4.4, 4.8 and appendix A.
#include "lab/mie/mie.h"

#include "src/base/angles.h"
#include "src/base/exponential.h"

namespace pileus {
namespace {

/// Droplets larger than this many effective radii send less than 1e-6 of the light anywhere.
constexpr double kLargest = 4;

struct Complex {
    double re, im;
    double square() const { return re * re + im * im; }
};

struct Coefficients {
    std::vector<Complex> a, b;  ///< of n = 1, 2 ...
};

/// p / (p - i q), for real p and q.
Complex ratio(double p, double q) {
    const double s = p * p + q * q;
    return {p * p / s, p * q / s};
}

/// Whole number of terms after which the sum has converged (Wiscombe 1980).
std::size_t terms_of(double x) {
    double root = 1;
    for (int i = 0; i < 60; ++i) root = (2 * root + x / (root * root)) / 3;
    return std::size_t(x + 4.05 * root + 3);
}

/// Of a sphere that absorbs nothing, whose coefficients are p / (p - i q).
void fill(double x, double index, Coefficients& out) {
    const std::size_t terms = terms_of(x);
    // Logarithmic derivative of psi inside, downwards: there errors shrink.
    const double y = x * index;
    std::vector<double> log_slope(terms_of(y) + 32, 0.0);
    for (std::size_t n = log_slope.size() - 1; n >= 1; --n) {
        const double step = double(n) / y;
        log_slope[n - 1] = step - 1 / (log_slope[n] + step);
    }
    out.a.clear();
    out.b.clear();
    const SineCosine at = sincos_deg(x * (180 / kPi64));
    double psi_before = at.cosine, psi = at.sine, chi_before = -at.sine, chi = at.cosine;
    for (std::size_t n = 1; n <= terms; ++n) {
        const double order = double(n);
        const double psi_next = (2 * order - 1) / x * psi - psi_before;
        const double chi_next = (2 * order - 1) / x * chi - chi_before;
        psi_before = psi, psi = psi_next, chi_before = chi, chi = chi_next;
        const double electric = log_slope[n] / index + order / x;
        const double magnetic = log_slope[n] * index + order / x;
        out.a.push_back(ratio(electric * psi - psi_before, electric * chi - chi_before));
        out.b.push_back(ratio(magnetic * psi - psi_before, magnetic * chi - chi_before));
    }
}

/// Sums over n without their common factors.
struct Sums {
    double scattering = 0;  ///< x^2 / 2 times the efficiency
    double cosine = 0;      ///< the same times the mean cosine
};
Sums sums_of(const Coefficients& c) {
    Sums s;
    const auto product = [](const Complex& u, const Complex& v) {
        return u.re * v.re + u.im * v.im;
    };
    for (std::size_t i = 0; i < c.a.size(); ++i) {
        const double n = double(i + 1);
        s.scattering += (2 * n + 1) * (c.a[i].square() + c.b[i].square());
        s.cosine += 2 * (2 * n + 1) / (n * (n + 1)) * product(c.a[i], c.b[i]);
        if (i + 1 < c.a.size())
            s.cosine += 2 * n * (n + 2) / (n + 1) *
                        (product(c.a[i], c.a[i + 1]) + product(c.b[i], c.b[i + 1]));
    }
    return s;
}

/// Adds number * (|S1|^2 + |S2|^2) of one sphere at every angle.
void add_intensity(const Coefficients& c, const std::vector<double>& cosine, double number,
                   std::vector<double>& sum) {
    for (std::size_t k = 0; k < cosine.size(); ++k) {
        const double mu = cosine[k];
        double pi_before = 0, pi = 1;
        Complex s1{0, 0}, s2{0, 0};
        for (std::size_t i = 0; i < c.a.size(); ++i) {
            const double n = double(i + 1), f = (2 * n + 1) / (n * (n + 1));
            const double tau = n * mu * pi - (n + 1) * pi_before;
            const double p = f * pi, t = f * tau;
            s1.re += p * c.a[i].re + t * c.b[i].re;
            s1.im += p * c.a[i].im + t * c.b[i].im;
            s2.re += t * c.a[i].re + p * c.b[i].re;
            s2.im += t * c.a[i].im + p * c.b[i].im;
            const double next = ((2 * n + 1) * mu * pi - (n + 1) * pi_before) / n;
            pi_before = pi;
            pi = next;
        }
        sum[k] += number * (s1.square() + s2.square());
    }
}

}  // namespace

void mie_sphere(double x, double index, double& extinction_efficiency, double& mean_cosine) {
    Coefficients c;
    fill(x, index, c);
    const Sums s = sums_of(c);
    extinction_efficiency = 2 * s.scattering / (x * x);
    mean_cosine = s.cosine / s.scattering;
}

MieResult mie_cloud(const MieCloud& cloud, const std::vector<double>& angle_deg) {
    MieResult result;
    result.density.assign(angle_deg.size(), 0.0);
    std::vector<double> cosine;
    cosine.reserve(angle_deg.size());
    for (double angle : angle_deg) cosine.push_back(sincos_deg(angle).cosine);
    const double scale = 2 * kPi64 * cloud.effective_radius_um / cloud.wavelength_um;
    double scattering = 0, forward = 0, area = 0;
    Coefficients c;
    const int count = int(kLargest * scale / cloud.size_step);
    for (int i = 0; i < count; ++i) {
        const double x = (i + 0.5) * cloud.size_step, r = x / scale;
        const double r2 = r * r, number = r2 * r2 * r2 * r * exponential(10 - 10 * r);
        fill(x, cloud.index, c);
        const Sums s = sums_of(c);
        scattering += number * s.scattering;
        forward += number * s.cosine;
        area += number * x * x;
        add_intensity(c, cosine, number, result.density);
    }
    result.extinction_efficiency = 2 * scattering / area;
    result.mean_cosine = forward / scattering;
    // (|S1|^2 + |S2|^2) / (2 k^2 C), with C k^2 = 2 pi times the sum.
    for (double& v : result.density) v /= 4 * kPi64 * scattering;
    return result;
}

std::vector<double> mie_table_angles() {
    struct Part {
        double until, step;
    };
    constexpr Part kParts[] = {{0.5, 0.025}, {2, 0.05},  {6, 0.1},   {10, 0.25},
                               {20, 0.5},    {110, 1},   {130, 0.5}, {160, 0.25},
                               {170, 0.5},   {177, 0.1}, {180, 0.05}};
    std::vector<double> angles;
    double begin = 0;
    for (const Part& part : kParts) {
        const int steps = int((part.until - begin) / part.step + 0.5);
        for (int i = 0; i < steps; ++i) angles.push_back(begin + i * part.step);
        begin = part.until;
    }
    angles.push_back(180);
    // Hundredths of a degree, as they are stored.
    for (double& a : angles) a = double(int(a * 100 + 0.5)) / 100;
    return angles;
}

}  // namespace pileus
