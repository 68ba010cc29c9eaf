// SPDX-License-Identifier: Apache-2.0
// Four numbers of each node side by side, read between nodes: a corner is one line of memory.
// in: [node][4], places -> out: four lanes' numbers, with the bits of four grids read one by one.
// docs/performance.md, "A march's look-ups"
#pragma once
#include "kernels_cpu/media/medium.h"

namespace pileus {
inline namespace PILEUS_ISA {

template <class T>
PILEUS_FN T mix_(T a, T b, T f) {
    return a + (b - a) * f;
}

#if !defined(__CUDACC__)
PILEUS_FN F<4> load_quad(const float* from) {
    F<4> v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
}
PILEUS_FN F<8> join_lanes(F<4> low, F<4> high) {
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
PILEUS_FN F<16> join_lanes(F<8> low, F<8> high) {
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

/// Rows of four numbers become columns.
PILEUS_FN void turn_quads(const F<4>* rows, F<4> (&out)[4]) {
    const F<4> a = __builtin_shufflevector(rows[0], rows[1], 0, 4, 1, 5);
    const F<4> b = __builtin_shufflevector(rows[2], rows[3], 0, 4, 1, 5);
    const F<4> c = __builtin_shufflevector(rows[0], rows[1], 2, 6, 3, 7);
    const F<4> d = __builtin_shufflevector(rows[2], rows[3], 2, 6, 3, 7);
    out[0] = __builtin_shufflevector(a, b, 0, 1, 4, 5);
    out[1] = __builtin_shufflevector(a, b, 2, 3, 6, 7);
    out[2] = __builtin_shufflevector(c, d, 0, 1, 4, 5);
    out[3] = __builtin_shufflevector(c, d, 2, 3, 6, 7);
}
PILEUS_FN void turn_quads(const F<4>* rows, F<8> (&out)[4]) {
    F<4> low[4], high[4];
    turn_quads(rows, low);
    turn_quads(rows + 4, high);
    for (int i = 0; i < 4; ++i) out[i] = join_lanes(low[i], high[i]);
}
PILEUS_FN void turn_quads(const F<4>* rows, F<16> (&out)[4]) {
    F<8> low[4], high[4];
    turn_quads(rows, low);
    turn_quads(rows + 8, high);
    for (int i = 0; i < 4; ++i) out[i] = join_lanes(low[i], high[i]);
}
#endif

/// What interpolate() gives for each of the four numbers at one place.
PILEUS_FN void interpolate_quad(const float* quads, const Corners<float>& c, float (&out)[4]) {
#if !defined(__CUDACC__)
    const auto row = [&](std::int32_t yz) {
        return mix_(load_quad(quads + 4 * (yz + c.x0)), load_quad(quads + 4 * (yz + c.x1)),
                    all<F<4>>(c.fx));
    };
    const F<4> fy = all<F<4>>(c.fy), fz = all<F<4>>(c.fz);
    const F<4> sum = mix_(mix_(row(c.z0 + c.y0), row(c.z0 + c.y1), fy),
                          mix_(row(c.z1 + c.y0), row(c.z1 + c.y1), fy), fz);
    __builtin_memcpy(out, &sum, sizeof sum);
#else
    for (int i = 0; i < 4; ++i) {
        const auto row = [&](std::int32_t yz) {
            return mix_(quads[4 * (yz + c.x0) + i], quads[4 * (yz + c.x1) + i], c.fx);
        };
        out[i] = mix_(mix_(row(c.z0 + c.y0), row(c.z0 + c.y1), c.fy),
                      mix_(row(c.z1 + c.y0), row(c.z1 + c.y1), c.fy), c.fz);
    }
#endif
}

/// What interpolate() gives for each of the four numbers, of the lanes that are wanted; others are
/// any. All eight corners' numbers are finite.
template <class T>
PILEUS_FN void interpolate_quads(const float* quads, const Corners<T>& c, std::uint32_t wanted,
                                 T (&out)[4]) {
    constexpr int W = width_of<T>;
    if constexpr (W == 1) {
        (void)wanted;
        interpolate_quad(quads, c, out);
    } else {
#if !defined(__CUDACC__)
        // Both slices side by side: the low half holds those of z0, the high half those of z1.
        const I<W> rows[4] = {(c.z0 + c.y0) * 4, (c.z1 + c.y0) * 4, (c.z0 + c.y1) * 4,
                              (c.z1 + c.y1) * 4};
        const I<W> columns[2] = {c.x0 * 4, c.x1 * 4};
        F<4> of_lane[W] = {};
        for (int l = 0; l < W; ++l) {
            if ((wanted >> l & 1) == 0) continue;
            const float* x0 = quads + lane(columns[0], l);
            const float* x1 = quads + lane(columns[1], l);
            const auto both = [&](const float* x, int row) {
                return join_lanes(load_quad(x + lane(rows[row], l)),
                                  load_quad(x + lane(rows[row + 1], l)));
            };
            const F<8> fx = all<F<8>>(lane(c.fx, l)), fy = all<F<8>>(lane(c.fy, l));
            const F<8> slices =
                mix_(mix_(both(x0, 0), both(x1, 0), fx), mix_(both(x0, 2), both(x1, 2), fx), fy);
            const F<4> low = __builtin_shufflevector(slices, slices, 0, 1, 2, 3);
            const F<4> high = __builtin_shufflevector(slices, slices, 4, 5, 6, 7);
            of_lane[l] = mix_(low, high, all<F<4>>(lane(c.fz, l)));
        }
        turn_quads(of_lane, out);
#endif
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
