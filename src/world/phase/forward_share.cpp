// SPDX-License-Identifier: Apache-2.0
// See forward_share.h.
// in: a phase function and an angle -> out: its integral up to there.
// docs/raymarch.md, "Forward scattering".
#include "src/world/phase/forward_share.h"

#include "src/base/angles.h"
#include "src/world/phase/phase_table.h"

namespace pileus {
namespace {

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
    return kTwoPi64 * limit * sum / (6.0 * kPanels);
}

double at_most_one(double v) { return v < 0 ? 0 : v > 1 ? 1 : v; }

/// 1 - cos without cancellation: 2 sin^2 of half the angle.
double one_minus_cos(double angle_deg) {
    const double half = sincos_deg(0.5 * angle_deg).sine;
    return 2 * half * half;
}

/// Simpson's rule over one panel of 1 - cos.
double panel(const PhaseParams& p, double begin, double end) {
    constexpr int kParts = 32;
    double sum = 0;
    for (int i = 0; i <= kParts; ++i) {
        const double weight = i == 0 || i == kParts ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * double(phase_density(p, float(begin + (end - begin) * i / kParts)));
    }
    return sum * (end - begin) / (3 * kParts);
}

/// Whether the sums below know the type better than by its density.
bool is_closed(const PhaseParams& p) {
    return p.type == kPhaseHg || p.type == kPhaseTwoLobe || p.type == kPhaseHgDraine;
}

}  // namespace

double forward_share_by_density(const PhaseParams& p, double half_deg) {
    const double x = one_minus_cos(half_deg);
    double sum = 0;
    // Panels that halve towards both ends resolve peaks there, as far as floats tell angles apart.
    for (double outer = 1, inner; outer > 0; outer = inner) {
        inner = outer > 0x1p-48 ? 0.5 * outer : 0;
        if (x > inner) sum += panel(p, inner, x < outer ? x : outer);
    }
    for (double outer = 1, inner; outer > 0; outer = inner) {
        inner = outer > 0x1p-24 ? 0.5 * outer : 0;
        if (x > 2 - outer) sum += panel(p, 2 - outer, x < 2 - inner ? x : 2 - inner);
    }
    return at_most_one(kTwoPi64 * sum);
}

double forward_share(const PhaseParams& p, double half_deg) {
    const double x = one_minus_cos(half_deg), c = 1 - x;
    if (p.type == kPhaseTable) return at_most_one(phase_table_share(*p.table, half_deg));
    if (p.type == kPhaseRayleigh) return at_most_one(0.375 * x + 0.125 * x * (1 + c + c * c));
    if (!is_closed(p)) return forward_share_by_density(p, half_deg);
    const double first = hg_share(double(p.g1), x);
    if (p.type == kPhaseHg) return at_most_one(first);
    const double second = p.type == kPhaseHgDraine ? draine_share(p, x) : hg_share(double(p.g2), x);
    return at_most_one(double(p.weight) * first + (1 - double(p.weight)) * second);
}

NeedleShares needle_shares(const PhaseParams& p) {
    NeedleShares out;
    const auto add = [&](float g, double weight) {
        if (g >= 1) out.forward += weight;
        if (g <= -1) out.backward += weight;
    };
    const bool two = p.type == kPhaseTwoLobe || p.type == kPhaseHgDraine;
    if (p.type == kPhaseHg) add(p.g1, 1);
    if (two) add(p.g1, double(p.weight));
    if (p.type == kPhaseTwoLobe) add(p.g2, 1 - double(p.weight));
    return out;
}

float diffusion_exponent(const PhaseParams& phase, float albedo) {
    const float g = phase_moment(phase, 1), square = 3 * (1 - albedo) * (1 - albedo * g);
    return square < 1 ? (square > 0 ? __builtin_sqrtf(square) : 0.0f) : 1.0f;
}

}  // namespace pileus
