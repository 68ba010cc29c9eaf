// SPDX-License-Identifier: Apache-2.0
// Counts the light that leaves a medium's box through its top and bottom, by place.
// in: lanes that leave -> out: deposits in the collectors of their faces.
// docs/flux.md, "By photons"
#pragma once
#include "kernels_cpu/photons/deposit.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Deposits the weights of the lanes that leave through the top or the bottom.
template <int W, int NC, bool S>
PILEUS_FN void meter_exits(const Photon<W, NC, S>& s, const TraceParams& k, const TraceBuffers& b,
                           M<W> top, M<W> bottom) {
    using T = F<W>;
    const M<W> m = top | bottom;
    if (!any(m)) return;
    const auto along = [](T at, std::int32_t n) {
        return min_(max_(to_int(at), I<W>{}), all<I<W>>(n - 1));
    };
    const std::int32_t nx = k.grid.size[0], ny = k.grid.size[1];
    const I<W> straight = select(s.order == 0, all<I<W>>(1), I<W>{});
    const I<W> face =
        select(top, all<I<W>>(std::int32_t{kTopTurned}), all<I<W>>(std::int32_t{kBottomTurned})) +
        straight;
    const I<W> place = (face * ny + along(s.p.y, ny)) * nx + along(s.p.x, nx);
    const I<W> entry = place + std::int32_t(voxels_of(k.grid));
    const I<W> collector = gather(b.collector, select(m, entry, I<W>{}));
    for (int c = 0; c < NC; ++c) {
        const T weight = select(s.shadow, T{} - s.weight[c], s.weight[c]);
        const I<W> quanta = quantise(weight, k.scale);
        add_lanes<W>(k, b, bits_of(m), collector, &quanta, c, 0, 1);
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
