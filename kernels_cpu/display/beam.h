// SPDX-License-Identifier: Apache-2.0
// Light that scatterings within a phase function's peak leave in its beam, from tables.
// in: a turn, what the beam has come through -> out: its light per unit, by channel.
// docs/methods.md 3, "The beam's peak"; src/world/light/beam.h makes the tables.
#pragma once
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/display/march_params.h"
#include "kernels_cpu/media/phase_table.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Share of a phase function that is its peak, of a width by 1 - cos.
template <class T>
PILEUS_FN T share_in_peak(T turn, float width) {
    return exp_(T{} - min_(turn * (1.0f / width), all<T>(80.0f)));
}

/// Where the tables hold a turn: a cell, and the place in it.
template <class T>
struct BeamAngle {
    I_of<T> cell;
    T within;
};

/// A turn by 1 - cos = x, which rounding may lead out of [0, 2].
template <class T>
PILEUS_FN BeamAngle<T> beam_angle(T x) {
    const T turn = max_(min_(x, all<T>(2.0f)), T{});
    const T at = even_at_ends(turn) * float(kBeamAngles);
    BeamAngle<T> a;
    a.cell = min_(to_int(at), all<I_of<T>>(kBeamAngles - 1));
    a.within = at - to_float(a.cell);
    return a;
}

/// Light of a beam that is `visible` where its optical depth is `tau`, scattered within its peak
/// before it leaves by the angle: the tables between their nodes, times what is left of the beam.
/// `rest`: share of extinction that takes light out of it; `most`: of any phase function, 1/sr.
template <class T>
PILEUS_FN void beam_light(const float* tables, std::int32_t sets, const float (&rest)[3],
                          const BeamAngle<T>& a, T most, T tau, T visible, T (&out)[3]) {
    const T at = tau / (tau + kBeamDepth) * float(kBeamDepths);
    const I_of<T> depth = min_(to_int(at), all<I_of<T>>(kBeamDepths - 1));
    const T f = at - to_float(depth);
    const I_of<T> node = a.cell * (kBeamDepths + 1) + depth;
    T light{};
    for (int c = 0; c < 3; ++c) {
        if (c < sets) {
            const float* table = tables + c * kBeamNumbers;
            const T near = gather(table, node), far = gather(table, node + 1);
            const T near_up = gather(table, node + (kBeamDepths + 1)),
                    far_up = gather(table, node + (kBeamDepths + 2));
            const T low = near + f * (far - near), high = near_up + f * (far_up - near_up);
            const T left = exp_(T{} - tau * rest[c]);
            // Of all that was scattered within the peak, which is tau where a float sees no less.
            const T all_of_it = max_(left - exp_(T{} - tau), min_(tau, all<T>(1e-5f)));
            light =
                min_(visible * left * (low + a.within * (high - low)), visible * most * all_of_it);
        }
        out[c] = light;
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
