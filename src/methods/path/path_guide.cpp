// SPDX-License-Identifier: Apache-2.0
// See path_guide.h.
#include "src/methods/path/path_guide.h"

#include "kernels_cpu/media/phase.h"

namespace pileus {
namespace {

/// Density at the rim of the cone, 1/sr (measured: docs/path.md, "Guide").
constexpr float kGuideFoot = 2;
/// Turns at which densities are compared: 1 - cos from 0.5 down by this factor each, and 0.
constexpr int kTurns = 128;
constexpr float kTurnStep = 0.87f;
/// Mean cosines that are tried: 1 - g from 0.3 down by this factor each.
constexpr int kTrials = 128;
constexpr float kTrialStep = 0.9f;

/// The largest of the media's densities, 1/sr.
float densest(const Medium& medium, float turn) {
    float most = 0;
    for (int i = 0; i < medium.count; ++i) {
        const float density = phase_density(medium.optics[std::size_t(i)].phase, turn);
        most = density > most ? density : most;
    }
    return most;
}

/// Share of the light of Henyey-Greenstein that turns by less, in a form in which nothing cancels.
double share_within(double g, double turn) {
    const double a = 1 - g, r = __builtin_sqrt(a * a + 2 * g * turn);
    return (1 - g * g) * turn / (a * r * (a + r));
}

}  // namespace

GuideParams fit_guide(const Medium& medium) {
    GuideParams guide{};
    float turn[kTurns + 1], density[kTurns + 1], most = 0;
    int rim = -1;
    for (int i = 0; i <= kTurns; ++i) {
        turn[i] = i == kTurns ? 0 : i == 0 ? 0.5f : turn[i - 1] * kTurnStep;
        density[i] = densest(medium, turn[i]);
        most = density[i] > most ? density[i] : most;
        if (rim < 0 && density[i] > kGuideFoot) rim = i;
    }
    if (!(most > kPeaked) || rim < 0) return guide;
    if (rim > 0) --rim;
    guide.cone = turn[rim];

    // Where the guide is thin, what a branch brings is bright: let the thinnest be as dense as can
    // be.
    double best = 0;
    float edge = 0.3f;
    for (int trial = 0; trial < kTrials; ++trial, edge *= kTrialStep) {
        const float g = 1.0f - edge;
        const double share = share_within(double(g), double(guide.cone));
        double least = 1e30;
        for (int i = rim; i <= kTurns; ++i) {
            if (!(density[i] > 0)) continue;
            const double ratio = double(hg_density(g, turn[i])) / (share * double(density[i]));
            least = ratio < least ? ratio : least;
        }
        if (least <= best) continue;
        best = least;
        guide.g = g;
        guide.share = float(share);
        guide.unit = float(1 / share);
    }
    guide.on = best > 0 ? 1 : 0;
    guide.worth = kGuideWorth;
    return guide;
}

}  // namespace pileus
