// SPDX-License-Identifier: Apache-2.0
// See forward_share.h.
// in: a phase function and an angle -> out: its integral up to there.
// docs/raymarch.md, "Forward scattering".
#include "src/world/phase/forward_share.h"

#include "src/base/angles.h"
#include "src/world/phase/phase_table.h"

namespace pileus {
namespace {

constexpr double kTwoPi = 6.28318530717958647693;

/// Of Henyey-Greenstein up to 1 - cos = x: the integral of (1 - g^2)/2 (a^2 + 2 g x)^-1.5 with
/// a = 1 - g, brought to a form in which nothing cancels, at g = 0 either.
double hg_share(double g, double x) {
    const double a = 1 - g, r = __builtin_sqrt(a * a + 2 * g * x);
    if (!(r > 0)) return x > 0 ? 1 : 0;
    if (a <= 0) return x > 0 ? 1 : 0;
    return (1 - g * g) * x / (a * r * (a + r));
}

/// Simpson's rule over u with x = limit u^3: it follows peaks of any sharpness near 0.
double draine_share(const PhaseParams& p, double limit) {
    constexpr int kPanels = 4096;
    double sum = 0;
    for (int i = 0; i <= 2 * kPanels; ++i) {
        const double u = double(i) / (2 * kPanels);
        const double weight = i == 0 || i == 2 * kPanels ? 1 : i % 2 == 1 ? 4 : 2;
        const float x = float(limit * u * u * u);
        sum += weight * 3 * u * u * double(draine_density(p.g2, p.alpha, x));
    }
    return kTwoPi * limit * sum / (6.0 * kPanels);
}

double at_most_one(double v) { return v < 0 ? 0 : v > 1 ? 1 : v; }

}  // namespace

double forward_share(const PhaseParams& p, double half_deg) {
    // 1 - cos without cancellation: 2 sin^2 of half the angle.
    const double half = sincos_deg(0.5 * half_deg).sine, x = 2 * half * half, c = 1 - x;
    if (p.type == kPhaseTable) return at_most_one(phase_table_share(*p.table, half_deg));
    if (p.type == kPhaseRayleigh) return at_most_one(0.375 * x + 0.125 * x * (1 + c + c * c));
    const double first = hg_share(double(p.g1), x);
    if (p.type == kPhaseHg) return at_most_one(first);
    const double second = p.type == kPhaseHgDraine ? draine_share(p, x) : hg_share(double(p.g2), x);
    return at_most_one(double(p.weight) * first + (1 - double(p.weight)) * second);
}

}  // namespace pileus
