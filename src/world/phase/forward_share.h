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

}  // namespace pileus
