// SPDX-License-Identifier: Apache-2.0
// Share of scattered light that a phase function keeps within a cone around its way.
// in: a phase function, half the cone's angle at its apex -> out: a share in [0, 1].
// docs/raymarch.md, "Forward scattering"; Palenik 2016, 3.2.
#pragma once
#include "kernels_cpu/media/phase.h"

namespace pileus {

/// In closed form for Henyey-Greenstein, Rayleigh and tables, to 1e-6 for what is mixed with
/// Draine, and for any other by its density. `half_deg` in [0, 180].
double forward_share(const PhaseParams& phase, double half_deg);

/// The same by the density alone, to 1e-5 where that is smooth but for peaks straight on and
/// straight back.
double forward_share_by_density(const PhaseParams& phase, double half_deg);

/// Shares of light that go exactly straight on, or straight back: no density tells of them. Lobes
/// of g = 1 or -1 have them.
struct NeedleShares {
    double forward = 0, backward = 0;
    bool any() const { return forward > 0 || backward > 0; }
};
NeedleShares needle_shares(const PhaseParams& phase);

/// How light fades deep inside a medium where it was scattered often, per optical depth: by
/// diffusion, sqrt(3 (1 - a) (1 - a g)), at most 1 (van de Hulst, "Multiple Light Scattering",
/// 1980, 14.1). 0 where nothing is absorbed.
float diffusion_exponent(const PhaseParams& phase, float albedo);

}  // namespace pileus
