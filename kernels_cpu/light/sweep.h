// SPDX-License-Identifier: Apache-2.0
// The sun's optical depth on the voxels' centres, slice by slice away from the sun.
// in: densities, weights of a node's neighbours -> out: optical depth per voxel, O(voxels).
// docs/buffer.md: tau = bilinear tau on the slice above + the exact integral of the trilinear
// field. A node looks only at neighbours that are 0 or 1 steps nearer the sun along each axis. So
// rows and planes may be walked in any order that comes from the sun, and blocks of them are
// independent along diagonals, whichever axis the slices follow. Every node's sum has one order of
// its terms.
#pragma once
#include "kernels_cpu/core/lanes.h"
#include "kernels_cpu/light/sweep_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Sums stop here: infinity times a weight of 0 would be no number.
constexpr float kMaxOpticalDepth = 1e30f;

template <class T>
PILEUS_FN T load_sweep(const float* from) {
    T v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
}

/// The weights of a node, in lanes or, for all lanes the same, as plain numbers.
template <class T, class Weight>
PILEUS_FN T sweep_sum(const Weight (&above)[4], const Weight (&far)[4], const Weight (&near)[4],
                      const T (&tau)[4], const T (&beyond)[4], const T (&own)[4]) {
    // What is above comes last: along x it is the result of the node before, which is waited for.
    T sum = own[0] * near[0];
    for (int i = 1; i < 4; ++i) sum = sum + own[i] * near[i];
    for (int i = 0; i < 4; ++i) sum = sum + beyond[i] * far[i];
    for (int i = 0; i < 4; ++i) sum = sum + tau[i] * above[i];
    return min_(sum, all<T>(kMaxOpticalDepth));
}

/// Rows along x: [0] at the node, [1] a step towards the sun along the other lesser axis.
struct SweepRows {
    const float *above[2], *far[2], *near[2];
    float* out;
};

/// sizeof(T)/4 nodes from x on; `u`: places to the neighbours along x.
template <class T>
PILEUS_FN void sweep_nodes(const SweepTaps& w, const SweepRows& r, std::int32_t x, std::int32_t u) {
    T tau[4], beyond[4], own[4];
    for (int i = 0; i < 4; ++i) {
        const std::int32_t at = (i & 1) != 0 ? x + u : x;
        tau[i] = load_sweep<T>(r.above[i / 2] + at);
        beyond[i] = load_sweep<T>(r.far[i / 2] + at);
        own[i] = load_sweep<T>(r.near[i / 2] + at);
    }
    const T sum = sweep_sum(w.above, w.far, w.near, tau, beyond, own);
    __builtin_memcpy(r.out + x, &sum, sizeof sum);
}

/// A whole row; its column nearest the sun has weights of its own.
template <int W>
PILEUS_FN void sweep_row(const SweepTaps& inner, const SweepTaps& rim, const SweepRows& r,
                         std::int32_t columns, std::int32_t u) {
    sweep_nodes<float>(rim, r, u > 0 ? columns - 1 : 0, 0);
    const std::int32_t begin = u > 0 ? 0 : 1, end = u > 0 ? columns - 1 : columns;
    std::int32_t x = begin;
    for (; x + W <= end; x += W) sweep_nodes<F<W>>(inner, r, x, u);
    for (; x < end; ++x) sweep_nodes<float>(inner, r, x, u);
}

/// The n-th of `count` places when walking away from the sun.
PILEUS_FN std::int32_t from_sun(std::int32_t n, std::int32_t count, std::int32_t step) {
    return step > 0 ? count - 1 - n : n;
}

/// Rows and planes of one block, numbered from the sun, half-open.
struct SweepBlock {
    std::int32_t y0, y1, z0, z1;
};
PILEUS_FN SweepBlock sweep_block_at(const SweepParams& k, std::uint32_t block) {
    const std::int32_t y = std::int32_t(block) % k.blocks[0] * k.edge[0];
    const std::int32_t z = std::int32_t(block) / k.blocks[0] * k.edge[1];
    return {y, min_(y + k.edge[0], k.size[1]), z, min_(z + k.edge[1], k.size[2])};
}

/// Slices along y or z: rows along x side by side.
template <int W>
PILEUS_FN void sweep_block_of_rows(const SweepParams& k, const SweepBuffers& b, SweepBlock block) {
    const std::int64_t nx = k.size[0];
    const bool by_planes = k.axis == 2;
    for (std::int32_t n = block.z0; n < block.z1; ++n)
        for (std::int32_t m = block.y0; m < block.y1; ++m) {
            const std::int64_t y = from_sun(m, k.size[1], k.step[1]);
            const std::int64_t z = from_sun(n, k.size[2], k.step[2]);
            const std::int64_t row = (z * k.size[1] + y) * nx;
            const std::int64_t up_y = m > 0 ? k.step[1] * nx : 0;
            const std::int64_t up_z = n > 0 ? k.step[2] * nx * k.size[1] : 0;
            const std::int64_t up = by_planes ? up_z : up_y, v = by_planes ? up_y : up_z;
            const bool top = by_planes ? n == 0 : m == 0, rim = by_planes ? m == 0 : n == 0;
            // Nothing lies above the top: its weights there are 0, for any number that is one.
            const float* above = top ? b.density : b.optical_depth;
            const SweepRows rows{{above + row + up, above + row + up + v},
                                 {b.density + row + up, b.density + row + up + v},
                                 {b.density + row, b.density + row + v},
                                 b.optical_depth + row};
            const SweepTaps* taps = k.taps + (top ? kSweepTop : 0) + (rim ? kSweepRimV : 0);
            sweep_row<W>(taps[0], taps[kSweepRimU], rows, k.size[0], k.step[0]);
        }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
