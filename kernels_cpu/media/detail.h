// SPDX-License-Identifier: Apache-2.0
// Detail beyond the grid: a density between grid points times a factor of noise, whose mean is 1.
// in: a density, its place in box-local metres, the tile -> out: the density with detail, >= 0.
// docs/detail.md, "Formula"
#pragma once
#include "kernels_cpu/media/detail_params.h"
#include "kernels_cpu/media/medium.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// The noise of the tile at a place, at least -1, mean 0 over a tile: linear between its numbers.
template <class T>
PILEUS_FN T detail_noise(const DetailView& k, const Vec<T>& metres) {
    using II = I_of<T>;
    const auto split = [&](T at, int axis, II& low, T& fraction) {
        const T c =
            min_(wrap_place(at, k.period[axis]) * k.per_metre[axis], all<T>(float(k.cells)));
        low = min_(to_int(c), all<II>(k.cells - 1));
        fraction = c - to_float(low);
    };
    const std::int32_t row = k.cells + 1;
    Corners<T> c;
    split(metres.x, 0, c.x0, c.fx);
    split(metres.y, 1, c.y0, c.fy);
    split(metres.z, 2, c.z0, c.fz);
    c.x1 = c.x0 + 1;
    c.y0 = c.y0 * row, c.z0 = c.z0 * (row * row);
    c.y1 = c.y0 + row, c.z1 = c.z0 + row * row;
    return interpolate(k.tile, c);
}

/// Less of the strength is left where the density is high: edges are eroded, cores stay.
template <class T>
PILEUS_FN T with_detail(const DetailView& k, const Vec<T>& metres, T density) {
    const T share = k.strength * (1.0f - k.core * density);
    return density * max_(1.0f + share * detail_noise(k, metres), T{});
}

}  // namespace PILEUS_ISA
}  // namespace pileus
