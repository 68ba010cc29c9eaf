// SPDX-License-Identifier: Apache-2.0
// The sun's light that scatterings within the peak of a phase function leave in its beam.
// in: a medium, 1 - cos of a cone -> out: tables that the march reads.
// docs/methods.md 3, "The beam's peak": small-angle scattering, Goudsmit and Saunderson (1940).
#pragma once
#include "kernels_cpu/display/march_params.h"
#include "src/world/medium/medium.h"

namespace pileus {

/// Scatterings that turn by less than a cone's half angle keep light in the beam. It is shown as if
/// it had come straight through what else takes light away, with the spread of direction that so
/// many turns give: for one medium of albedo w, per unit of w and of the irradiance E,
///     S(angle, tau) = p e^(-tau) + e^(-tau (1 - w f)) Q(angle, tau),
///     Q = sum_l (2l+1)/4pi chi_l (e^(-tau w (f - c_l)) - e^(-tau w f)) P_l(cos angle),
/// chi_l the moments of p, c_l those of p within the cone, f = c_0.
/// From a point, light that is turned at the share u of its way comes from u times that angle off
/// the point in the end: there c_l is the mean of c_ul over u.
struct Beam {
    double shares[kMaxMedia] = {};  ///< f of each medium
    int sets = 0;                   ///< one a channel of the medium; 0: there are no tables
    bool points = false;            ///< there are those of points, too
    float rest[3] = {};             ///< 1 - w f
    Buffer<float> tables;           ///< Q: [parallel, from a point][set][angle][depth]
};

namespace arrays {

/// `sets`: those for points included.
inline Array<float> beam_tables(std::uint64_t sets, Stage first) {
    return {"beam by angle and depth", bytes_of(sets, std::uint64_t(kBeamNumbers)), first,
            Stage::kWrite};
}

}  // namespace arrays

/// 1 - cos of an angle in degrees.
float turn_of_deg(double deg);

/// Share of an extinction that counts where turns within the peak do not, `share` of them.
inline double counting_share(const Optics& optics, std::size_t channel, double share) {
    return 1 - double(optics.albedo[channel]) * share;
}

/// Legendre moments c_l of a phase function within its peak, w p of width `peak_turn` (1 - cos), as
/// many as count.
std::vector<double> peak_moments(const PhaseParams& phase, float peak_turn);

/// Which scatterings out of the beam a table has: all, or those within the peak alone, where p is
/// p within the cone and chi_l = c_l.
enum class BeamTurns { kAll, kPeak };

/// Tables of the first medium, or where `kPeak` is asked of several of their mean by extinction
/// over the grid, and a cone by its 1 - cos; `points`: those of points, too. kLimit: out of memory.
Status make_beam(const Medium& medium, float peak_turn, bool points, BeamTurns turns, int threads,
                 Stage first, Beam& out);

}  // namespace pileus
